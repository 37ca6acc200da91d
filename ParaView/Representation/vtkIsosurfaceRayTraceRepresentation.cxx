// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceRepresentation.h"

#include "vtkIsosurfaceRayTraceMapper.h"
#include "vtkIsosurfaceRayTracePiece.h"
#include "vtkIsosurfaceRayTraceRefinement.h"
#include "vtkIsosurfaceVolume.h"

#include "vtkColorTransferFunction.h"
#include "vtkCommand.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkContourValues.h"
#include "vtkDataArray.h"
#include "vtkDiscretizableColorTransferFunction.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkPVPlane.h"
#include "vtkPVRenderView.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPlane.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkVolumeProperty.h"

#include <algorithm>

VTK_ABI_NAMESPACE_BEGIN

namespace
{
//------------------------------------------------------------------------------
int GetNumberOfProcesses()
{
  auto* controller = vtkMultiProcessController::GetGlobalController();
  return controller ? controller->GetNumberOfProcesses() : 1;
}

//------------------------------------------------------------------------------
bool IsFirstProcess()
{
  auto* controller = vtkMultiProcessController::GetGlobalController();
  return !controller || controller->GetLocalProcessId() == 0;
}

//------------------------------------------------------------------------------
bool IsInteractive(vtkPVRenderView* view)
{
  // It sets a rate far below 1 for still pictures, on all processes.
  return view->GetRenderWindow()->GetDesiredUpdateRate() > 1.0;
}

//------------------------------------------------------------------------------
void GetTransformedBounds(const double bounds[6], vtkMatrix4x4* matrix, double transformed[6])
{
  const vtkBoundingBox box(bounds);
  vtkBoundingBox around;
  for (int i = 0; i < 8 && box.IsValid(); ++i)
  {
    double corner[4] = { 0.0, 0.0, 0.0, 1.0 };
    box.GetCorner(i, corner);
    matrix->MultiplyPoint(corner, corner);
    around.AddPoint(corner);
  }
  vtkMath::UninitializeBounds(transformed);
  if (around.IsValid())
  {
    around.GetBounds(transformed);
  }
}
}

//------------------------------------------------------------------------------
vtkStandardNewMacro(vtkIsosurfaceRayTraceRepresentation);

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceRepresentation::vtkIsosurfaceRayTraceRepresentation()
{
  // Each process would choose a distance of its own.
  this->Mapper->AutoAdjustSampleDistancesOff();
  this->Mapper->SetCompositeDataDisplayAttributes(this->BlocksOfMapper);
  this->Volume->SetMapper(this->Mapper);
  this->Volume->GetProperty()->ShadeOn();
  this->SetDiffuseColor(1.0, 1.0, 1.0);
  this->SetOpacity(1.0);
  vtkMath::UninitializeBounds(this->OwnBounds);
  this->Shown.Representation = this;
  this->Shown.Volume = this->Volume;
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceRepresentation::~vtkIsosurfaceRayTraceRepresentation()
{
  if (this->SharedPicture)
  {
    this->SharedPicture->Remove(&this->Shown);
  }
}

//------------------------------------------------------------------------------
int vtkIsosurfaceRayTraceRepresentation::FillInputPortInformation(
  int vtkNotUsed(port), vtkInformation* info)
{
  for (const char* type : { "vtkImageData", "vtkRectilinearGrid", "vtkStructuredGrid",
         "vtkUnstructuredGridBase", "vtkCompositeDataSet" })
  {
    info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), type);
  }
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1); // a client has none
  return 1;
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceRepresentation::AddToView(vtkView* view)
{
  auto* renderView = vtkPVRenderView::SafeDownCast(view);
  if (!renderView || !this->Superclass::AddToView(view))
  {
    return false;
  }
  vtkRenderer* renderer = renderView->GetRenderer();
  renderer->AddViewProp(this->Volume);
  renderView->RegisterPropForHardwareSelection(this, this->Volume);
  this->SharedPicture = vtkIsosurfaceRayTraceSharedPicture::Of(renderView);
  this->SharedPicture->Add(&this->Shown);
  this->Observer = renderer->AddObserver(
    vtkCommand::EndEvent, this, &vtkIsosurfaceRayTraceRepresentation::ContinueRefinement);
  return true;
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceRepresentation::RemoveFromView(vtkView* view)
{
  auto* renderView = vtkPVRenderView::SafeDownCast(view);
  if (!renderView)
  {
    return false;
  }
  renderView->UnRegisterPropForHardwareSelection(this, this->Volume);
  renderView->GetRenderer()->RemoveViewProp(this->Volume);
  renderView->GetRenderer()->RemoveObserver(this->Observer);
  this->SharedPicture->Remove(&this->Shown);
  this->SharedPicture = nullptr;
  this->Refinement->Stop();
  return this->Superclass::RemoveFromView(view);
}

//------------------------------------------------------------------------------
int vtkIsosurfaceRayTraceRepresentation::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** in, vtkInformationVector* out)
{
  this->Superclass::RequestUpdateExtent(request, in, out);
  if (GetNumberOfProcesses() > 1 && in[0]->GetNumberOfInformationObjects() > 0)
  {
    in[0]->GetInformationObject(0)->Set(
      vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(),
      this->GetNumberOfGhostLevels());
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkIsosurfaceRayTraceRepresentation::GetNumberOfGhostLevels()
{
  const bool isCubic = this->Mapper->GetInterpolationMode() == vtkIsosurfaceRayTraceMapper::CUBIC;
  const bool areCells = this->GetContourAssociation() == vtkDataObject::FIELD_ASSOCIATION_CELLS;
  return isCubic || areCells ? 2 : 1;
}

//------------------------------------------------------------------------------
int vtkIsosurfaceRayTraceRepresentation::RequestData(
  vtkInformation* request, vtkInformationVector** in, vtkInformationVector* out)
{
  this->OwnPiece = nullptr;
  if (vtkDataObject* input = vtkDataObject::GetData(in[0], 0))
  {
    this->OwnPiece = vtkIsosurfaceRayTracePiece::MakeInput(input);
  }
  this->IsPieceNew = true;
  this->Piece = this->OwnPiece;
  return this->Superclass::RequestData(request, in, out);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::ReportMissingArray()
{
  // Not all processes need have it.
  if (this->NumberOfComponents == 0 && IsFirstProcess())
  {
    vtkErrorMacro("There is no array \""
      << this->GetContourArrayName()
      << "\" of points or cells to contour. Choose one in "
         "\"Contour By\"; data without arrays of numbers cannot be shown by isosurfaces.");
  }
}

//------------------------------------------------------------------------------
int vtkIsosurfaceRayTraceRepresentation::ProcessViewRequest(
  vtkInformationRequestKey* type, vtkInformation* in, vtkInformation* out)
{
  if (!this->Superclass::ProcessViewRequest(type, in, out))
  {
    return 0;
  }
  if (type == vtkPVView::REQUEST_UPDATE())
  {
    this->DescribePiece(in, out);
  }
  else if (type == vtkPVView::REQUEST_UPDATE_LOD())
  {
    vtkPVRenderView::SetRequiresDistributedRenderingLOD(in, this, true);
  }
  else if (type == vtkPVView::REQUEST_RENDER())
  {
    this->PrepareToRender(in);
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::DescribePiece(vtkInformation* in, vtkInformation* out)
{
  if (this->IsPieceNew || this->BlocksOfPiece->GetMTime() < this->BlockStylesTime)
  {
    this->BlockStyles.Apply(this->OwnPiece, this->BlocksOfPiece);
    this->BlocksOfPiece->Modified();
    const vtkBoundingBox own =
      vtkIsosurfaceRayTracePiece::GetOwnBounds(this->OwnPiece, this->BlocksOfPiece);
    vtkMath::UninitializeBounds(this->OwnBounds);
    if (own.IsValid())
    {
      own.GetBounds(this->OwnBounds);
    }
  }
  vtkNew<vtkMatrix4x4> matrix;
  this->Volume->GetMatrix(matrix);
  double bounds[6];
  GetTransformedBounds(this->OwnBounds, matrix, bounds);
  vtkDataArray* array = vtkIsosurfaceRayTracePiece::FindArray(
    this->Piece, this->GetContourAssociation(), this->GetContourArrayName());
  const vtkIsosurfaceRayTracePiece::Together together =
    vtkIsosurfaceRayTracePiece::Gather(bounds, array ? array->GetNumberOfComponents() : 0,
      this->IsPieceNew && vtkIsosurfaceRayTracePiece::IsAmr(this->OwnPiece));
  if (together.HasNewAmr)
  {
    this->Piece = vtkIsosurfaceRayTracePiece::AddGhostBlocks(this->OwnPiece);
  }
  this->NumberOfComponents = together.NumberOfComponents;
  const bool isAnyThere = std::any_of(together.Bounds.begin(), together.Bounds.end(),
    [](const vtkBoundingBox& piece) { return piece.IsValid(); });
  if (this->IsPieceNew && isAnyThere)
  {
    this->ReportMissingArray();
  }
  this->IsPieceNew = false;
  this->Shown.Bounds = together.Bounds;
  this->Shown.IsOpaque = this->IsOpaque();
  this->SharedPicture->TellBounds(in);
  vtkPVView::SetPiece(in, this, this->Piece);
  vtkPVRenderView::SetRequiresDistributedRendering(in, this, true);
  // Opaque surfaces are composited by depth: exactly, whatever the shape of the pieces.
  out->Set(vtkPVRenderView::NEED_ORDERED_COMPOSITING(), this->IsOpaque() ? 0 : 1);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::PrepareToRender(vtkInformation* in)
{
  vtkDataObject* piece = vtkPVView::GetDeliveredPiece(in, this);
  if (!piece ||
    !vtkIsosurfaceRayTracePiece::FindArray(
      piece, this->GetContourAssociation(), this->GetContourArrayName()))
  {
    this->Mapper->RemoveAllInputs();
  }
  else
  {
    this->SetInput(piece);
  }
  // All processes have the same settings, with data or without: the compositor insists on it.
  this->UpdateMapper();
  this->UpdateColors();
  this->UpdateClippingPlane();
  this->WarnOfSecondaryRays();
  auto* view = vtkPVRenderView::SafeDownCast(this->GetView());
  if (!this->IsOpaque())
  {
    // ParaView peels volumes together with translucent polygons; isosurfaces are peeled as polygons
    // are, or not at all.
    view->GetRenderer()->UseDepthPeelingForVolumesOff();
  }
  this->Shown.HasData = this->Mapper->GetNumberOfInputConnections(0) > 0;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::ContinueRefinement()
{
  auto* view = vtkPVRenderView::SafeDownCast(this->GetView());
  if (this->Mapper->GetProgressiveAccumulation() && this->GetVisibility() && !IsInteractive(view) &&
    !view->GetRenderer()->GetSelector() && !this->SharedPicture->IsUsed())
  {
    this->Refinement->Continue(view, this->Mapper->GetMaximumNumberOfAccumulatedFrames());
  }
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::SetInput(vtkDataObject* piece)
{
  const bool isOther = this->Mapper->GetDataObjectInput() != piece;
  if (isOther)
  {
    this->Mapper->SetInputDataObject(piece);
  }
  const vtkMTimeType time = this->BlocksOfMapper->GetMTime();
  if (isOther || time < piece->GetMTime() || time < this->BlockStylesTime)
  {
    this->BlockStyles.Apply(piece, this->BlocksOfMapper);
    this->BlocksOfMapper->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::UpdateMapper()
{
  const int association = this->GetContourAssociation();
  const std::string name = this->GetContourArrayName();
  const bool areCells = association == vtkDataObject::FIELD_ASSOCIATION_CELLS;
  this->Mapper->SetScalarMode(
    areCells ? VTK_SCALAR_MODE_USE_CELL_FIELD_DATA : VTK_SCALAR_MODE_USE_POINT_FIELD_DATA);
  this->Mapper->SelectScalarArray(name.c_str());

  const bool isMagnitude = this->Component >= this->NumberOfComponents;
  this->Mapper->SetVectorMode(
    isMagnitude ? vtkIsosurfaceRayTraceMapper::MAGNITUDE : vtkIsosurfaceRayTraceMapper::COMPONENT);
  this->Mapper->SetVectorComponent(this->Component);

  const bool isInteractive = IsInteractive(vtkPVRenderView::SafeDownCast(this->GetView()));
  this->Mapper->SetImageSampleDistance(static_cast<float>(
    isInteractive ? this->InteractiveImageSampleDistance : this->ImageSampleDistance));
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::UpdateColors()
{
  const bool isOneColor = this->ColorArrayName.empty() || !this->LookupTable;
  const bool isByArray = !isOneColor && !this->IsColoredByContourArray();
  this->Mapper->SetColorArrayName(isByArray ? this->ColorArrayName.c_str() : "");
  this->Volume->GetProperty()->SetColor(
    isOneColor ? this->OneColor.Get() : this->LookupTable.Get());

  auto* table = vtkDiscretizableColorTransferFunction::SafeDownCast(this->LookupTable);
  vtkPiecewiseFunction* function = table ? table->GetScalarOpacityFunction() : nullptr;
  const bool isByFunction = function && this->UseOpacityFunction && this->IsColoredByContourArray();
  this->Volume->GetProperty()->SetScalarOpacity(isByFunction ? function : this->OneOpacity.Get());
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::UpdateClippingPlane()
{
  if (this->ClippingPlane)
  {
    vtkNew<vtkPlane> plane;
    plane->SetOrigin(this->ClippingPlane->GetOrigin());
    plane->SetNormal(this->ClippingPlane->GetNormal());
    plane->Push(this->ClippingPlane->GetOffset());
    this->PlaneOfMapper->SetOrigin(plane->GetOrigin());
    this->PlaneOfMapper->SetNormal(plane->GetNormal());
  }
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::WarnOfSecondaryRays()
{
  const bool areSecondary = this->Mapper->GetShadows() || this->Mapper->GetAmbientOcclusion();
  if (areSecondary && GetNumberOfProcesses() > 1 && !this->HasWarnedOfSecondaryRays)
  {
    this->HasWarnedOfSecondaryRays = true;
    if (IsFirstProcess())
    {
      vtkWarningMacro(
        "On several processes, shadows and ambient occlusion end at the pieces of the "
        "processes, and the picture has seams there. Switch them off, or use one process.");
    }
  }
}

//------------------------------------------------------------------------------
int vtkIsosurfaceRayTraceRepresentation::GetContourAssociation()
{
  vtkInformation* array = this->GetInputArrayInformation(0);
  return array->Has(vtkDataObject::FIELD_ASSOCIATION())
    ? array->Get(vtkDataObject::FIELD_ASSOCIATION())
    : vtkDataObject::FIELD_ASSOCIATION_POINTS;
}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceRepresentation::GetContourArrayName()
{
  const char* name = this->GetInputArrayInformation(0)->Get(vtkDataObject::FIELD_NAME());
  return name ? name : "";
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceRepresentation::IsColoredByContourArray()
{
  const bool isSameArray = this->ColorArrayName == this->GetContourArrayName() &&
    this->ColorAssociation == this->GetContourAssociation();
  if (this->NumberOfComponents < 2 || !this->LookupTable)
  {
    return isSameArray;
  }
  return isSameArray &&
    (this->LookupTable->GetVectorMode() == vtkScalarsToColors::MAGNITUDE
        ? this->Component >= this->NumberOfComponents
        : this->Component == this->LookupTable->GetVectorComponent());
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceRepresentation::IsOpaque()
{
  return this->OneOpacity->GetValue(0.0) >= 1.0 && !this->BlockStyles.AreSomeTranslucent() &&
    !(this->UseOpacityFunction && this->IsColoredByContourArray());
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::SetInputArrayToProcess(
  int index, int port, int connection, int association, const char* name)
{
  this->Superclass::SetInputArrayToProcess(index, port, connection, association, name);
  this->MarkModified(); // other layers of ghosts may be needed
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::SetInterpolationMode(int mode)
{
  this->Mapper->SetInterpolationMode(mode);
  this->MarkModified(); // other layers of ghosts may be needed
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::SetComponent(int component)
{
  this->Component = component;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::SetNumberOfIsovalues(int number)
{
  this->Volume->GetProperty()->GetIsoSurfaceValues()->SetNumberOfContours(number);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::SetIsovalue(int index, double value)
{
  this->Volume->GetProperty()->GetIsoSurfaceValues()->SetValue(index, value);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::SetColorArray(int vtkNotUsed(index), int vtkNotUsed(port),
  int vtkNotUsed(connection), int association, const char* name)
{
  this->ColorAssociation = association;
  this->ColorArrayName = name ? name : "";
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::SetLookupTable(vtkColorTransferFunction* colors)
{
  this->LookupTable = colors;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::SetDiffuseColor(double red, double green, double blue)
{
  this->OneColor->RemoveAllPoints();
  this->OneColor->AddRGBPoint(0.0, red, green, blue);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::SetOpacity(double opacity)
{
  this->OneOpacity->RemoveAllPoints();
  this->OneOpacity->AddPoint(0.0, opacity);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::SetUseOpacityFunction(bool use)
{
  this->UseOpacityFunction = use;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::AddBlockSelector(const char* selector)
{
  this->BlockStyles.AddVisible(selector);
  this->BlockStylesTime.Modified();
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::RemoveAllBlockSelectors()
{
  this->BlockStyles.RemoveVisible();
  this->BlockStylesTime.Modified();
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::SetBlockColor(
  const char* selector, double red, double green, double blue)
{
  this->BlockStyles.SetColor(selector, { red, green, blue });
  this->BlockStylesTime.Modified();
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::RemoveAllBlockColors()
{
  this->BlockStyles.RemoveColors();
  this->BlockStylesTime.Modified();
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::SetBlockOpacity(const char* selector, double opacity)
{
  this->BlockStyles.SetOpacity(selector, opacity);
  this->BlockStylesTime.Modified();
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::RemoveAllBlockOpacities()
{
  this->BlockStyles.RemoveOpacities();
  this->BlockStylesTime.Modified();
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::SetShade(bool shade)
{
  this->Volume->GetProperty()->SetShade(shade);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::SetAmbient(double ambient)
{
  this->Volume->GetProperty()->SetAmbient(ambient);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::SetDiffuse(double diffuse)
{
  this->Volume->GetProperty()->SetDiffuse(diffuse);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::SetSpecular(double specular)
{
  this->Volume->GetProperty()->SetSpecular(specular);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::SetSpecularPower(double power)
{
  this->Volume->GetProperty()->SetSpecularPower(power);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::SetNormalMode(int mode)
{
  this->Mapper->SetNormalMode(mode);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::SetShadows(bool on)
{
  this->Mapper->SetShadows(on);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::SetAmbientOcclusion(bool on)
{
  this->Mapper->SetAmbientOcclusion(on);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::SetProgressiveAccumulation(bool on)
{
  this->Mapper->SetProgressiveAccumulation(on);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::SetCapClippingPlanes(bool on)
{
  this->Mapper->SetCapClippingPlanes(on);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::SetClippingPlane(vtkPVPlane* plane)
{
  this->ClippingPlane = plane;
  this->Mapper->RemoveAllClippingPlanes();
  if (plane)
  {
    this->Mapper->AddClippingPlane(this->PlaneOfMapper);
  }
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::SetImageSampleDistance(double distance)
{
  this->ImageSampleDistance = distance;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::SetInteractiveImageSampleDistance(double distance)
{
  this->InteractiveImageSampleDistance = distance;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::SetVisibility(bool visible)
{
  this->Superclass::SetVisibility(visible);
  this->Volume->SetVisibility(visible);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::SetPosition(double x, double y, double z)
{
  this->Volume->SetPosition(x, y, z);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::SetScale(double x, double y, double z)
{
  this->Volume->SetScale(x, y, z);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::SetOrientation(double x, double y, double z)
{
  this->Volume->SetOrientation(x, y, z);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::SetOrigin(double x, double y, double z)
{
  this->Volume->SetOrigin(x, y, z);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::SetPickable(bool pickable)
{
  this->Volume->SetPickable(pickable);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Component: " << this->Component << "\n";
  os << indent << "ColorArrayName: " << this->ColorArrayName << "\n";
  os << indent << "UseOpacityFunction: " << this->UseOpacityFunction << "\n";
  os << indent << "ImageSampleDistance: " << this->ImageSampleDistance << "\n";
  os << indent << "InteractiveImageSampleDistance: " << this->InteractiveImageSampleDistance
     << "\n";
  os << indent << "Mapper:\n";
  this->Mapper->PrintSelf(os, indent.GetNextIndent());
}

VTK_ABI_NAMESPACE_END
