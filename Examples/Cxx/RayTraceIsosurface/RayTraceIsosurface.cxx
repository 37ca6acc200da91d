// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Ray traces an isosurface of a volume read from a file: writes pictures of it and prints times and
// memory, or opens a window (--interactive). RayTraceIsosurface --help lists the options.

#include "vtkIsosurfaceComparisonFilter.h"
#include "vtkIsosurfaceRayTraceMapper.h"

#include <vtkAbstractArray.h>
#include <vtkActor.h>
#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkColorTransferFunction.h>
#include <vtkCommand.h>
#include <vtkConeSource.h>
#include <vtkContourValues.h>
#include <vtkDataArray.h>
#include <vtkExecutive.h>
#include <vtkImageData.h>
#include <vtkImageReader2.h>
#include <vtkImageReader2Factory.h>
#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkLightKit.h>
#include <vtkMatrix4x4.h>
#include <vtkNIFTIImageReader.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkProperty2D.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkSliderRepresentation2D.h>
#include <vtkSliderWidget.h>
#include <vtkSmartPointer.h>
#include <vtkTable.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkUnsignedCharArray.h>
#include <vtkVariant.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>
#include <vtkWindowToImageFilter.h>
#include <vtkXMLImageDataReader.h>
#include <vtksys/CommandLineArguments.hxx>
#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <new>
#include <string>
#include <vector>

namespace
{

constexpr double NotGiven = std::numeric_limits<double>::quiet_NaN();
constexpr double MillisecondsPerSecond = 1000.0;
constexpr double BytesPerMebibyte = 1024.0 * 1024.0;

struct Arguments
{
  std::string Input;
  double Isovalue = NotGiven;
  double Skin = NotGiven;
  std::string Output = ".";
  int Size = 800;
  int Threads = 0;
  bool Interactive = false;
  bool Help = false;
};

//------------------------------------------------------------------------------
// Returns false after printing the help, if it was requested or the options are invalid.
bool ParseArguments(int argc, char* argv[], Arguments& arguments)
{
  using Parser = vtksys::CommandLineArguments;
  Parser parser;
  parser.Initialize(argc, argv);
  parser.AddArgument("--input", Parser::SPACE_ARGUMENT, &arguments.Input,
    "The volume: .vti, .nii, .mhd or any other image that VTK reads.");
  parser.AddArgument("--isovalue", Parser::SPACE_ARGUMENT, &arguments.Isovalue,
    "The isovalue of the opaque surface. Default: the middle of the range of the data.");
  parser.AddArgument("--skin", Parser::SPACE_ARGUMENT, &arguments.Skin,
    "The isovalue of a translucent surface around it. Default: none.");
  parser.AddArgument("--output", Parser::SPACE_ARGUMENT, &arguments.Output,
    "The folder of the pictures. Default: the current one.");
  parser.AddArgument("--size", Parser::SPACE_ARGUMENT, &arguments.Size,
    "Width and height of the pictures in pixels. Default: 800.");
  parser.AddArgument("--threads", Parser::SPACE_ARGUMENT, &arguments.Threads,
    "The number of threads. Default: 0, all of the machine.");
  parser.AddBooleanArgument(
    "--interactive", &arguments.Interactive, "Open a window instead of writing pictures.");
  parser.AddBooleanArgument("--help", &arguments.Help, "Show this text.");

  const bool parsed = parser.Parse() != 0;
  const bool sensible = !arguments.Input.empty() && arguments.Size > 0 && arguments.Threads >= 0;
  if (arguments.Help || !parsed || !sensible)
  {
    std::printf("Usage: RayTraceIsosurface --input FILE [options]\n%s", parser.GetHelp());
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
// The reader for the extension of the file name, or nullptr.
vtkSmartPointer<vtkAlgorithm> NewReader(const std::string& fileName)
{
  const std::string name = vtksys::SystemTools::LowerCase(fileName);
  if (vtksys::SystemTools::StringEndsWith(name, ".vti"))
  {
    auto reader = vtkSmartPointer<vtkXMLImageDataReader>::New();
    reader->SetFileName(fileName.c_str());
    return reader;
  }
  vtkSmartPointer<vtkImageReader2> reader;
  if (vtksys::SystemTools::StringEndsWith(name, ".nii") ||
    vtksys::SystemTools::StringEndsWith(name, ".nii.gz"))
  {
    reader = vtkSmartPointer<vtkNIFTIImageReader>::New();
  }
  else
  {
    reader.TakeReference(vtkImageReader2Factory::CreateImageReader2(fileName.c_str()));
  }
  if (reader)
  {
    reader->SetFileName(fileName.c_str());
  }
  return reader;
}

//------------------------------------------------------------------------------
// False if the reader fails; what it says of that is not printed.
bool Update(vtkAlgorithm* reader)
{
  int errors = 0;
  vtkNew<vtkCallbackCommand> observer;
  observer->SetClientData(&errors);
  observer->SetCallback(
    [](vtkObject*, unsigned long, void* count, void*) { ++*static_cast<int*>(count); });
  reader->AddObserver(vtkCommand::ErrorEvent, observer);
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, observer);
  try
  {
    reader->Update();
  }
  catch (const std::bad_alloc&)
  {
    ++errors;
  }
  reader->RemoveObserver(observer);
  reader->GetExecutive()->RemoveObserver(observer);
  return errors == 0;
}

//------------------------------------------------------------------------------
// Whether a MetaImage has fewer bytes: VTK's reader leaves the other samples undefined.
bool IsCut(const std::string& fileName, double bytes)
{
  using vtksys::SystemTools;
  std::ifstream file(fileName);
  std::string name;
  std::string equals;
  std::string value;
  while (file >> name >> equals && equals == "=" && std::getline(file >> std::ws, value))
  {
    if (name == "CompressedData" && SystemTools::LowerCase(value) == "true")
    {
      bytes = 0.0; // unless the header has their number
    }
    if (name == "CompressedDataSize")
    {
      bytes = std::atof(value.c_str());
    }
    if (name == "ElementDataFile")
    {
      const std::string samples =
        value == "LOCAL" ? fileName : SystemTools::GetFilenamePath(fileName) + "/" + value;
      return SystemTools::FileExists(samples, true) &&
        static_cast<double>(SystemTools::FileLength(samples)) < bytes;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
// The volume in the file; nullptr after an error message.
vtkSmartPointer<vtkImageData> ReadVolume(const std::string& fileName)
{
  if (!vtksys::SystemTools::FileExists(fileName, true))
  {
    std::fprintf(stderr, "There is no file %s.\n", fileName.c_str());
    return nullptr;
  }
  const vtkSmartPointer<vtkAlgorithm> reader = NewReader(fileName);
  if (!reader)
  {
    std::fprintf(stderr, "VTK has no image reader for %s.\n", fileName.c_str());
    return nullptr;
  }
  if (!Update(reader))
  {
    std::fprintf(stderr, "%s is damaged, or larger than the memory.\n", fileName.c_str());
    return nullptr;
  }
  auto* volume = vtkImageData::SafeDownCast(reader->GetOutputDataObject(0));
  vtkDataArray* scalars = volume ? volume->GetPointData()->GetScalars() : nullptr;
  if (!scalars || volume->GetDataDimension() != 3)
  {
    std::fprintf(stderr, "%s is not a volume with point scalars.\n", fileName.c_str());
    return nullptr;
  }
  if (volume->GetIndexToPhysicalMatrix()->Determinant() == 0.0 ||
    IsCut(fileName, static_cast<double>(scalars->GetDataSize() * scalars->GetDataTypeSize())))
  {
    std::fprintf(stderr, "%s is damaged.\n", fileName.c_str());
    return nullptr;
  }
  return volume;
}

//------------------------------------------------------------------------------
// Sets the isovalues and their colours: an opaque surface, and a skin around it if one is given.
void SetSurfaces(vtkVolumeProperty* property, double isovalue, double skin)
{
  vtkContourValues* isovalues = property->GetIsoSurfaceValues();
  vtkColorTransferFunction* colors = property->GetRGBTransferFunction();
  vtkPiecewiseFunction* opacities = property->GetScalarOpacity();
  colors->RemoveAllPoints();
  opacities->RemoveAllPoints();

  isovalues->SetNumberOfContours(1);
  isovalues->SetValue(0, isovalue);
  colors->AddRGBPoint(isovalue, 0.96, 0.90, 0.80);
  opacities->AddPoint(isovalue, 1.0);
  if (!std::isnan(skin) && skin != isovalue)
  {
    isovalues->SetValue(1, skin);
    colors->AddRGBPoint(skin, 0.90, 0.58, 0.46);
    opacities->AddPoint(skin, 0.5);
  }
}

//------------------------------------------------------------------------------
// A volume with its mapper, in a lit renderer of a window.
struct Scene
{
  Scene(vtkImageData* image, const Arguments& arguments);

  vtkNew<vtkIsosurfaceRayTraceMapper> Mapper;
  vtkNew<vtkVolume> Volume;
  vtkNew<vtkLightKit> Lights;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
};

//------------------------------------------------------------------------------
// Looks at the +y side, slightly from one side and from above, with z up. That is the face of a
// head whose y axis runs from back to front.
void PlaceCamera(vtkRenderer* renderer)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  camera->SetPosition(-0.35, 1.0, 0.15);
  camera->SetViewUp(0.0, 0.0, 1.0);
  renderer->ResetCamera();
  camera->Zoom(1.5);
}

//------------------------------------------------------------------------------
Scene::Scene(vtkImageData* image, const Arguments& arguments)
{
  this->Mapper->SetInputData(image);
  this->Mapper->SetNumberOfThreads(arguments.Threads);

  vtkVolumeProperty* property = this->Volume->GetProperty();
  property->ShadeOn();
  property->SetAmbient(0.1);
  property->SetDiffuse(0.9);
  property->SetSpecular(0.2);
  property->SetSpecularPower(30.0);
  this->Volume->SetMapper(this->Mapper);

  this->Lights->SetKeyLightIntensity(0.9);
  this->Lights->AddLightsToRenderer(this->Renderer);
  this->Renderer->SetBackground(0.16, 0.18, 0.22);
  this->Renderer->SetBackground2(0.42, 0.46, 0.52);
  this->Renderer->GradientBackgroundOn();
  this->Renderer->AddVolume(this->Volume);
  PlaceCamera(this->Renderer);

  this->Window->SetMultiSamples(0);
  this->Window->SetSize(arguments.Size, arguments.Size);
  this->Window->SetWindowName("RayTraceIsosurface");
  this->Window->AddRenderer(this->Renderer);
}

//------------------------------------------------------------------------------
double SecondsOfRender(vtkRenderWindow* window)
{
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  window->Render();
  return std::chrono::duration<double>(Clock::now() - start).count();
}

//------------------------------------------------------------------------------
double Median(std::vector<double> values)
{
  const auto middle = values.begin() + values.size() / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

//------------------------------------------------------------------------------
// Once around the volume.
std::vector<double> SecondsOfOrbit(Scene& scene)
{
  const int numberOfFrames = 15;
  std::vector<double> seconds;
  for (int frame = 0; frame < numberOfFrames; ++frame)
  {
    scene.Renderer->GetActiveCamera()->Azimuth(360.0 / numberOfFrames);
    scene.Renderer->ResetCameraClippingRange();
    seconds.push_back(SecondsOfRender(scene.Window));
  }
  return seconds;
}

//------------------------------------------------------------------------------
void ReportVolume(vtkImageData* volume)
{
  const int* dimensions = volume->GetDimensions();
  const double* range = volume->GetScalarRange();
  std::printf("Volume\n");
  std::printf("  %d x %d x %d samples of type %s, %g to %g, %.1f MiB\n", dimensions[0],
    dimensions[1], dimensions[2], volume->GetScalarTypeAsString(), range[0], range[1],
    volume->GetActualMemorySize() / 1024.0);
}

//------------------------------------------------------------------------------
void PrintRow(const std::string& what, double seconds, double bytes, const std::string& note = "")
{
  std::printf("  %-18s %9.2f ms %9.2f MiB%s%s\n", what.c_str(), seconds * MillisecondsPerSecond,
    bytes / BytesPerMebibyte, note.empty() ? "" : "  ", note.c_str());
}

//------------------------------------------------------------------------------
std::string CountOfBricks(vtkIsosurfaceRayTraceMapper* mapper)
{
  return std::to_string(mapper->GetNumberOfBricks()) + " of " +
    std::to_string(mapper->GetMaximumNumberOfBricks()) + " bricks";
}

//------------------------------------------------------------------------------
// The first frame builds what the next ones use.
void ReportRayTracing(Scene& scene, double isovalue)
{
  vtkIsosurfaceRayTraceMapper* mapper = scene.Mapper;
  const auto memory = [mapper]()
  { return mapper->GetMacrocellMemory() + mapper->GetBrickMemory(); };
  const int* size = scene.Window->GetSize();
  std::printf("Ray traced at isovalue %g, %d x %d pixels\n", isovalue, size[0], size[1]);

  SetSurfaces(scene.Volume->GetProperty(), isovalue, NotGiven);
  scene.Volume->VisibilityOff();
  scene.Window->Render(); // opens the window, which is not part of the measurement
  scene.Volume->VisibilityOn();
  const double firstFrame = SecondsOfRender(scene.Window);
  PrintRow("first frame", firstFrame, memory());
  PrintRow("  macrocells", mapper->GetMacrocellBuildTime(), mapper->GetMacrocellMemory());
  PrintRow(
    "  bricks", mapper->GetBrickBuildTime(), mapper->GetBrickMemory(), CountOfBricks(mapper));
  const double nextFrame = Median(SecondsOfOrbit(scene));
  PrintRow("next frame, median", nextFrame, memory(), CountOfBricks(mapper) + ", once around");
}

//------------------------------------------------------------------------------
// A value of the table; the program ends with an error if there is no column of that name.
vtkVariant GetTableValue(vtkTable* table, vtkIdType row, const char* columnName)
{
  vtkAbstractArray* column = table->GetColumnByName(columnName);
  if (!column)
  {
    std::fprintf(stderr, "The comparison has no column %s.\n", columnName);
    std::exit(EXIT_FAILURE);
  }
  return column->GetVariantValue(row);
}

//------------------------------------------------------------------------------
struct ComparisonColumn
{
  const char* Heading;
  const char* Name; // in the table of vtkIsosurfaceComparisonFilter
  double Unit;
  const char* UnitName;
  int Decimals;
};

constexpr ComparisonColumn ComparisonColumns[] = {
  { "build", "BuildTime", 1.0 / MillisecondsPerSecond, " ms", 2 },
  { "extraction", "ExtractionTime", 1.0 / MillisecondsPerSecond, " ms", 2 },
  { "first picture", "FirstPictureTime", 1.0 / MillisecondsPerSecond, " ms", 2 },
  { "next picture", "NextPictureTime", 1.0 / MillisecondsPerSecond, " ms", 2 },
  { "new isovalue", "NewIsovaluePictureTime", 1.0 / MillisecondsPerSecond, " ms", 2 },
  { "memory", "Bytes", BytesPerMebibyte, " MiB", 2 },
  { "triangles", "Triangles", 1.0, "", 0 },
};

//------------------------------------------------------------------------------
void PrintComparison(vtkTable* table)
{
  std::printf("  %-27s", "");
  for (const ComparisonColumn& column : ComparisonColumns)
  {
    std::printf(" %14s", column.Heading);
  }
  std::printf("\n");
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    std::printf("  %-27s", GetTableValue(table, row, "Method").ToString().c_str());
    for (const ComparisonColumn& column : ComparisonColumns)
    {
      char text[32] = "-"; // for 0, and for NaN, which stands for what was not measured
      const double value = GetTableValue(table, row, column.Name).ToDouble();
      if (value > 0.0)
      {
        std::snprintf(
          text, sizeof(text), "%.*f%s", column.Decimals, value / column.Unit, column.UnitName);
      }
      std::printf(" %14s", text);
    }
    const std::string note = GetTableValue(table, row, "Note").ToString();
    std::printf("%s%s\n", note.empty() ? "" : "  ", note.c_str());
  }
}

//------------------------------------------------------------------------------
// Compares ray tracing with extraction of triangles for the same picture.
void ReportComparison(vtkImageData* volume, double isovalue, const Scene& scene)
{
  vtkNew<vtkIsosurfaceComparisonFilter> comparison;
  comparison->SetInputData(volume);
  comparison->SetValue(0, isovalue);
  comparison->SetCamera(scene.Renderer->GetActiveCamera());
  comparison->SetImageSize(scene.Window->GetSize());
  comparison->AccuracyOff();
  comparison->Update();
  std::printf("Compared with extraction of triangles, on all threads\n");
  PrintComparison(comparison->GetOutput());
}

//------------------------------------------------------------------------------
// Under another name first, so that the file is whole or absent.
bool WriteFile(vtkUnsignedCharArray* bytes, const std::string& fileName)
{
  const std::string part = fileName + ".part";
  std::ofstream file(part, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes->GetPointer(0)), bytes->GetNumberOfValues());
  file.close();
  if (file && std::rename(part.c_str(), fileName.c_str()) == 0)
  {
    return true;
  }
  const int error = errno;
  std::remove(part.c_str());
  errno = error;
  return false;
}

//------------------------------------------------------------------------------
bool WritePicture(vtkRenderWindow* window, const std::string& fileName)
{
  window->Render();
  vtkNew<vtkWindowToImageFilter> picture;
  picture->SetInput(window);
  picture->ReadFrontBufferOff();
  picture->ShouldRerenderOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(picture->GetOutputPort());
  writer->WriteToMemoryOn();
  writer->Write();
  if (!WriteFile(writer->GetResult(), fileName))
  {
    std::fprintf(stderr, "%s cannot be written: %s.\n", fileName.c_str(), std::strerror(errno));
    return false;
  }
  std::printf("  %s\n", fileName.c_str());
  return true;
}

//------------------------------------------------------------------------------
// A cone of polygons through the centre of the volume: the depth test is made for every pixel.
vtkSmartPointer<vtkActor> NewPiercingCone(vtkVolume* volume)
{
  vtkNew<vtkConeSource> cone;
  cone->SetCenter(volume->GetCenter());
  cone->SetDirection(-1.0, 0.35, -0.15);
  cone->SetHeight(volume->GetLength() * 0.65);
  cone->SetRadius(volume->GetLength() * 0.09);
  cone->SetResolution(128);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(cone->GetOutputPort());
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.20, 0.52, 0.62);
  actor->GetProperty()->SetSpecular(0.4);
  actor->GetProperty()->SetSpecularPower(40.0);
  return actor;
}

//------------------------------------------------------------------------------
bool WritePictures(Scene& scene, double isovalue, const Arguments& arguments)
{
  if (!vtksys::SystemTools::MakeDirectory(arguments.Output))
  {
    std::fprintf(stderr, "The folder %s cannot be created.\n", arguments.Output.c_str());
    return false;
  }
  const std::string folder = arguments.Output + "/";
  vtkVolumeProperty* property = scene.Volume->GetProperty();
  std::printf("Pictures\n");

  SetSurfaces(property, isovalue, NotGiven);
  bool written = WritePicture(scene.Window, folder + "bone.png");
  if (!std::isnan(arguments.Skin))
  {
    SetSurfaces(property, isovalue, arguments.Skin);
    written = WritePicture(scene.Window, folder + "bone-and-skin.png") && written;
    SetSurfaces(property, isovalue, NotGiven);
  }
  scene.Renderer->AddActor(NewPiercingCone(scene.Volume));
  return WritePicture(scene.Window, folder + "cone.png") && written;
}

//------------------------------------------------------------------------------
// A window with a slider for the isovalue.
class InteractiveView
{
public:
  InteractiveView(Scene& scene, const double range[2], double isovalue, double skin);
  void Start();

private:
  void SetUpSlider();
  void SetUpText();
  void SetIsovalue(double isovalue);
  void OnSlider();
  void OnKey();
  void OnRenderStart();

  Scene& TheScene;
  const double Lowest;
  const double Highest;
  const double Skin;
  vtkNew<vtkRenderWindowInteractor> Interactor;
  vtkNew<vtkSliderRepresentation2D> Slider;
  vtkNew<vtkSliderWidget> SliderWidget;
  vtkNew<vtkTextActor> Text;
};

//------------------------------------------------------------------------------
InteractiveView::InteractiveView(Scene& scene, const double range[2], double isovalue, double skin)
  : TheScene(scene)
  , Lowest(range[0])
  , Highest(range[1])
  , Skin(skin)
{
  vtkNew<vtkInteractorStyleTrackballCamera> style;
  this->Interactor->SetInteractorStyle(style);
  this->Interactor->SetRenderWindow(scene.Window);
  this->Interactor->AddObserver(vtkCommand::KeyPressEvent, this, &InteractiveView::OnKey);
  this->SetUpSlider();
  this->SetUpText();
  this->SetIsovalue(isovalue);
}

//------------------------------------------------------------------------------
void InteractiveView::SetUpSlider()
{
  this->Slider->SetMinimumValue(this->Lowest);
  this->Slider->SetMaximumValue(this->Highest);
  this->Slider->SetTitleText("isovalue");
  this->Slider->SetLabelFormat("%.4g");
  this->Slider->GetPoint1Coordinate()->SetCoordinateSystemToNormalizedViewport();
  this->Slider->GetPoint1Coordinate()->SetValue(0.25, 0.09);
  this->Slider->GetPoint2Coordinate()->SetCoordinateSystemToNormalizedViewport();
  this->Slider->GetPoint2Coordinate()->SetValue(0.75, 0.09);
  this->Slider->SetSliderLength(0.02);
  this->Slider->SetSliderWidth(0.03);
  this->Slider->SetTubeWidth(0.006);
  this->Slider->SetEndCapLength(0.0);
  this->Slider->SetTitleHeight(0.022);
  this->Slider->SetLabelHeight(0.022);
  this->Slider->GetSliderProperty()->SetColor(0.96, 0.90, 0.80);
  this->SliderWidget->SetInteractor(this->Interactor);
  this->SliderWidget->SetRepresentation(this->Slider);
  this->SliderWidget->SetAnimationModeToJump();
  this->SliderWidget->AddObserver(vtkCommand::InteractionEvent, this, &InteractiveView::OnSlider);
}

//------------------------------------------------------------------------------
void InteractiveView::SetUpText()
{
  this->Text->GetTextProperty()->SetFontSize(16);
  this->Text->SetPosition(12, 12);
  this->TheScene.Renderer->AddActor2D(this->Text);
  this->TheScene.Renderer->AddObserver(
    vtkCommand::StartEvent, this, &InteractiveView::OnRenderStart);
}

//------------------------------------------------------------------------------
void InteractiveView::SetIsovalue(double isovalue)
{
  this->Slider->SetValue(isovalue); // clamps it
  SetSurfaces(this->TheScene.Volume->GetProperty(), this->Slider->GetValue(), this->Skin);
}

//------------------------------------------------------------------------------
void InteractiveView::OnSlider()
{
  this->SetIsovalue(this->Slider->GetValue());
}

//------------------------------------------------------------------------------
void InteractiveView::OnKey()
{
  const std::string key = this->Interactor->GetKeySym();
  const double step = key == "Up" ? 0.01 : key == "Down" ? -0.01 : 0.0;
  if (step != 0.0)
  {
    this->SetIsovalue(this->Slider->GetValue() + step * (this->Highest - this->Lowest));
    this->Interactor->Render();
  }
}

//------------------------------------------------------------------------------
void InteractiveView::OnRenderStart()
{
  const double seconds = this->TheScene.Renderer->GetLastRenderTimeInSeconds();
  char text[64];
  std::snprintf(text, sizeof(text), "previous frame %.0f ms", seconds * MillisecondsPerSecond);
  this->Text->SetInput(text);
}

//------------------------------------------------------------------------------
void InteractiveView::Start()
{
  std::printf("Drag to rotate, with Shift to pan, with Ctrl to roll; the wheel zooms.\n"
              "The slider and the keys Up and Down change the isovalue.\n"
              "r resets the camera, q quits.\n");
  this->Interactor->Initialize();
  this->SliderWidget->EnabledOn();
  this->TheScene.Window->Render();
  this->Interactor->Start();
}

} // anonymous namespace

//------------------------------------------------------------------------------
int main(int argc, char* argv[])
{
  Arguments arguments;
  if (!ParseArguments(argc, argv, arguments))
  {
    return arguments.Help ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  const vtkSmartPointer<vtkImageData> volume = ReadVolume(arguments.Input);
  if (!volume)
  {
    return EXIT_FAILURE;
  }
  const std::string whyNot = vtkIsosurfaceComparisonFilter::WhyNoPictures();
  if (!whyNot.empty())
  {
    std::fprintf(stderr, "%s\n", whyNot.c_str());
    return EXIT_FAILURE;
  }
  const double* range = volume->GetScalarRange();
  const double isovalue =
    std::isnan(arguments.Isovalue) ? 0.5 * (range[0] + range[1]) : arguments.Isovalue;

  ReportVolume(volume);
  Scene scene(volume, arguments);
  if (arguments.Interactive)
  {
    InteractiveView(scene, range, isovalue, arguments.Skin).Start();
    return EXIT_SUCCESS;
  }
  scene.Window->SetOffScreenRendering(true);
  ReportRayTracing(scene, isovalue);
  ReportComparison(volume, isovalue, scene);
  const bool written = WritePictures(scene, isovalue, arguments);
  if (std::fflush(stdout) != 0)
  {
    std::fprintf(stderr, "The standard output cannot be written: %s.\n", std::strerror(errno));
    return EXIT_FAILURE;
  }
  return written ? EXIT_SUCCESS : EXIT_FAILURE;
}
