// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Mappers in several threads of the application.

#include "Checks.h"
#include "TestImages.h"
#include "TestScene.h"

#include <vtkCallbackCommand.h>
#include <vtkImageData.h>
#include <vtkLogger.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>

#include <atomic>
#include <cstring>
#include <thread>

using namespace MapperTesting;

namespace
{

constexpr int Repeats = 300;

/// Counts the errors, which come from any thread, instead of showing them.
class ErrorCounter : public vtkOutputWindow
{
public:
  vtkTypeMacro(ErrorCounter, vtkOutputWindow);
  static ErrorCounter* New();
  void DisplayText(const char* text) override
  {
    const bool isOurs =
      std::strstr(text, "Another thread is using the vtkIsosurfaceRayTraceMapper");
    (isOurs ? this->Expected : this->Others).fetch_add(1);
  }

  std::atomic<int> Expected{ 0 };
  std::atomic<int> Others{ 0 };
};
vtkStandardNewMacro(ErrorCounter);

/// A line from outside to the middle of a ball. Returns whether it hits; t is where.
bool CastLine(vtkIsosurfaceRayTraceMapper* mapper, vtkVolume* volume, double& t)
{
  const double from[3] = { 0.0, -4.0, 0.0 };
  const double to[3] = { 0.0, 0.0, 0.0 };
  double x[3];
  double pcoords[3];
  double isovalue;
  double normal[3];
  vtkIdType cell;
  return mapper->IntersectWithLine(volume, from, to, t, x, pcoords, cell, isovalue, normal) != 0;
}

/// Casts the line again and again. Returns how often it hit where it should.
int CountHits(vtkIsosurfaceRayTraceMapper* mapper, vtkVolume* volume, double expected, int& wrong)
{
  int hits = 0;
  for (int i = 0; i < Repeats; ++i)
  {
    double t = 0.0;
    if (CastLine(mapper, volume, t))
    {
      ++hits;
      wrong += t == expected ? 0 : 1;
    }
  }
  return hits;
}

void CheckMapperEach(Checks& check, vtkImageData* image, double expected)
{
  vtkNew<vtkImageData> copy;
  copy->ShallowCopy(image);
  Scene scenes[2] = { Scene(image), Scene(copy) };
  int hits[2] = { 0, 0 };
  int wrong[2] = { 0, 0 };
  std::thread other(
    [&] { hits[1] = CountHits(scenes[1].Mapper, scenes[1].Volume, expected, wrong[1]); });
  hits[0] = CountHits(scenes[0].Mapper, scenes[0].Volume, expected, wrong[0]);
  other.join();
  check.Equal(hits[0] + hits[1], 2 * Repeats, "the number of hits of two mappers");
  check.Equal(wrong[0] + wrong[1], 0, "the number of wrong hits of two mappers");
}

/// Each call either works or is an error.
void CheckOneMapper(Checks& check, vtkImageData* image, double expected)
{
  Scene scene(image);
  vtkNew<ErrorCounter> errors;
  vtkOutputWindow::SetInstance(errors);
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  int hits[2] = { 0, 0 };
  int wrong[2] = { 0, 0 };
  std::thread other([&] { hits[1] = CountHits(scene.Mapper, scene.Volume, expected, wrong[1]); });
  hits[0] = CountHits(scene.Mapper, scene.Volume, expected, wrong[0]);
  other.join();
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_INFO);
  vtkOutputWindow::SetInstance(nullptr);
  check.That(hits[0] + hits[1] > 0, "there are hits with one mapper");
  check.Equal(errors->Expected.load(), 2 * Repeats - hits[0] - hits[1], "the number of errors");
  check.Equal(errors->Others.load(), 0, "the number of other errors");
  check.Equal(wrong[0] + wrong[1], 0, "the number of wrong hits of one mapper");
  double t = 0.0;
  check.That(CastLine(scene.Mapper, scene.Volume, t) && t == expected, "the mapper works after it");
}

/// As long as one thread uses a mapper, another cannot: it is in an observer of the mapper here.
void CheckBusyMapper(Checks& check, vtkImageData* image)
{
  struct Attempt
  {
    Scene Drawn;
    bool HasHit = false;
  } attempt{ Scene(image) };
  vtkNew<vtkCallbackCommand> observer;
  observer->SetClientData(&attempt);
  observer->SetCallback(
    [](vtkObject*, unsigned long, void* data, void*)
    {
      auto* tried = static_cast<Attempt*>(data);
      std::thread other(
        [tried]
        {
          double t = 0.0;
          tried->HasHit = CastLine(tried->Drawn.Mapper, tried->Drawn.Volume, t);
        });
      other.join();
    });
  attempt.Drawn.Mapper->AddObserver(vtkCommand::VolumeMapperRenderStartEvent, observer);
  vtkNew<ErrorCounter> errors;
  vtkOutputWindow::SetInstance(errors);
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  attempt.Drawn.Window->Render();
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_INFO);
  vtkOutputWindow::SetInstance(nullptr);
  check.That(!attempt.HasHit, "a mapper that another thread uses does nothing");
  check.Equal(errors->Expected.load(), 1, "the number of errors of a mapper in use");
  check.Equal(errors->Others.load(), 0, "the number of other errors of a mapper in use");
}

}

int TestIsosurfaceRayTraceMapperThreads(int, char*[])
{
  Checks check;
  const auto image = NewBall(33, 0.7);
  Scene scene(image);
  double expected = 0.0;
  check.That(CastLine(scene.Mapper, scene.Volume, expected), "the line hits the ball");
  CheckMapperEach(check, image, expected);
  CheckOneMapper(check, image, expected);
  CheckBusyMapper(check, image);
  return check.Result();
}
