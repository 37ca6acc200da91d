// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Prints checksums of pictures, of an image and of a mesh. They are the same on every processor.
// (No function of the mathematical library is used, whose last digits may differ.)

#include "Image/ImageField.h"
#include "Kernels/InstructionSets.h"
#include "Matrices.h"
#include "Mesh/MeshField.h"
#include "Noise.h"
#include "Picture/RenderTiles.h"
#include "TestMesh.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iostream>
#include <vector>

using namespace vtkIsosurfaceRayTracing;

namespace
{

/// The FNV-1a checksum of numbers, by their bits.
class Checksum
{
public:
  template <typename T>
  void Add(const T& number)
  {
    unsigned char bytes[sizeof(T)];
    std::memcpy(bytes, &number, sizeof(T));
    for (const unsigned char byte : bytes)
    {
      this->Sum = (this->Sum ^ byte) * 0x100000001B3U;
    }
  }

  void Add(const Hit& hit)
  {
    this->Add(hit.T);
    this->Add(hit.Cell);
    this->Add(hit.Surface);
    for (const double coordinate : hit.Parametric)
    {
      this->Add(coordinate);
    }
  }

  std::uint64_t Get() const { return this->Sum; }

private:
  std::uint64_t Sum = 0xCBF29CE484222325U;
};

template <typename T>
std::uint64_t FindChecksum(const std::vector<T>& numbers)
{
  Checksum sum;
  for (const T& number : numbers)
  {
    sum.Add(number);
  }
  return sum.Get();
}

/// From the side, so that all faces of the box of a field are slanted, through its middle.
Camera MakeCamera(double size, int pixels)
{
  // Turns by the angles of the triangles with sides 3, 4, 5 and 5, 12, 13.
  const Matrix4 aboutZ = { 0.8, -0.6, 0.0, 0.0, 0.6, 0.8, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0,
    0.0, 1.0 };
  const double cosine = 5.0 / 13.0;
  const double sine = 12.0 / 13.0;
  const Matrix4 aboutX = { 1.0, 0.0, 0.0, 0.0, 0.0, cosine, -sine, 0.0, 0.0, sine, cosine, 0.0, 0.0,
    0.0, 0.0, 1.0 };
  const double middle = 0.5 * size;
  const Matrix4 toMiddle = Translation({ -middle, -middle, -middle });
  const Matrix4 away = Translation({ 0.0, 0.0, -2.0 * size });
  const Matrix4 clipFromObject = Multiply(Perspective(0.1 * size, 4.0 * size, 0.5),
    Multiply(away, Multiply(aboutX, Multiply(aboutZ, toMiddle))));
  return { clipFromObject, Invert(clipFromObject), Translation({}), static_cast<double>(pixels),
    static_cast<double>(pixels) };
}

/// Two surfaces, the outer one translucent, in the light.
void Print(const char* name, TracedField& field, double size, TraceRequest request)
{
  constexpr int pixels = 128;
  request.Surfaces = { { 50.0, 0.5 }, { 70.0, 1.0 } };
  const Execution execution = { 2, &GetBestKernels() };
  field.Select(request, execution);
  Scene scene;
  scene.Pixels = { 0, 0, pixels, pixels };
  scene.Lights = { Light() };
  scene.KeepHits = true;
  SceneField shown;
  shown.Field = &field;
  shown.View = MakeCamera(size, pixels);
  shown.Colors = { { 0.9, 0.8, 0.1 }, { 0.2, 0.4, 0.9 } };
  shown.Surface.Shade = true;
  scene.Fields = { shown };
  Frame frame;
  FrameTimes times;
  RenderTiles(scene, execution, frame, times, [](double) { return true; });
  const auto missed = std::count_if(frame.Hits.begin(), frame.Hits.end(),
    [](const Hit& hit) { return hit.Surface == Hit::NoSurface; });
  std::cout << std::dec << name << ": " << frame.Hits.size() - static_cast<std::size_t>(missed)
            << " hits " << std::hex << FindChecksum(frame.Hits) << ", depths "
            << FindChecksum(frame.Depths) << ", colors " << FindChecksum(frame.Colors) << '\n';
}

void PrintImage(const char* name, Interpolant interpolant)
{
  constexpr int size = 24;
  const TestVolume<float> volume = Noise<float>({ size, size, size }, 3);
  const auto image = ImageField::New(volume.View(), {}, 2);
  TraceRequest request;
  request.Interpolation = interpolant;
  Print(name, *image, size - 1.0, request);
}

void PrintMesh(const char* name, Cutting cutting)
{
  constexpr int size = 16;
  RandomNumbers random(5);
  RandomNumbers values(7);
  const TestMesh mesh = MakeMesh(random, { size, size, size }, cutting, 0.1,
    [&values](const Index3&) { return values.Integer(0, 120); });
  MeshField field(mesh.View(), 2);
  Print(name, field, size, {});
}

}

int main()
{
  PrintImage("nearest", Interpolant::Nearest);
  PrintImage("trilinear", Interpolant::Trilinear);
  PrintImage("tricubic", Interpolant::Tricubic);
  PrintMesh("tetrahedra", Cutting::Tetrahedra);
  PrintMesh("mixed cells", Cutting::Mixed);
}
