// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The data that a mapper traces, in parts: what requests, frames, hits and selections know of it.

#ifndef vtkIsosurfaceRayTraceInput_h
#define vtkIsosurfaceRayTraceInput_h

#include "vtkIsosurfaceRayTraceClouds.h"   // for ivars
#include "vtkIsosurfaceRayTraceLeaves.h"   // for ivars
#include "vtkIsosurfaceRayTracePart.h"     // for ivars
#include "vtkIsosurfaceRayTracePartSet.h"  // for ivars
#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkType.h"                       // for vtkIdType

#include "Field/EmptyField.h"
#include "Image/ImageSettings.h"
#include "Picture/Scene.h"

#include <functional> // for std::function
#include <map>        // for std::multimap
#include <memory>     // for std::unique_ptr
#include <optional>   // for std::optional
#include <string>     // for std::string
#include <vector>     // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkAbstractVolumeMapper;
class vtkCompositeDataDisplayAttributes;
class vtkDataArray;
class vtkDataObject;
class vtkDataSet;
class vtkGenericCell;
class vtkImageData;
class vtkIsosurfaceRayTraceValueColors;
class vtkObject;
class vtkVolumeMapper;
class vtkVolumeProperty;
struct vtkIsosurfaceRayTraceScalars;

/// The settings of a mapper that are about its input. They are documented there.
struct vtkIsosurfaceRayTraceInputSettings
{
  /// That of the scalars; none: the property decides.
  std::optional<int> Component;
  /// Whether a cloud takes all components where the property decides.
  bool TakesComponents = false;
  std::string ColorArrayName;
  /// If not null, it has the array to colour by.
  vtkImageData* ColorImage = nullptr;
  bool Tetrahedralize = false;
  vtkIsosurfaceRayTracing::ImageSettings Image;
  std::string CacheDirectory;
  /// How blocks are displayed; may be null.
  vtkCompositeDataDisplayAttributes* Attributes = nullptr;
  /// Crops images; may be null.
  vtkVolumeMapper* Cropping = nullptr;
  int Threads = 1;
};

class vtkIsosurfaceRayTraceInput
{
public:
  /// Of a connection of the first port. The mapper owns its inputs, and tells its settings.
  vtkIsosurfaceRayTraceInput(vtkAbstractVolumeMapper* mapper, int connection,
    std::function<vtkIsosurfaceRayTraceInputSettings()> getSettings);
  ~vtkIsosurfaceRayTraceInput();
  vtkIsosurfaceRayTraceInput(const vtkIsosurfaceRayTraceInput&) = delete;
  void operator=(const vtkIsosurfaceRayTraceInput&) = delete;

  /// Finds the data in the inputs of the mapper, which must be up to date, and their scalars.
  /// Returns why they cannot be traced; empty if they can.
  std::string Select(vtkVolumeProperty* property);

  /// Whether the connection has any points.
  bool HasData() const;

  /// Whether some of the data are a mesh, or there are none: others cannot be drawn as a cloud.
  bool MayHaveCloud() const;

  /// Instead of Select: the field has nothing.
  void SelectNothing();

  /// What is wrong with blocks that the last selection left out; empty if there are none.
  std::string DescribeLeftOut() const { return this->LeftOut.Describe(); }

  /// From the object space of what was selected to the coordinates of the data, before Update:
  /// where it is, it may be another.
  vtkIsosurfaceRayTracing::Matrix4 FindPhysicalFromObject() const;

  /// Builds what tracing the selection needs, or begins to. Returns whether a hierarchy had to be
  /// built.
  bool Update(int threads, vtkIsosurfaceRayTraceLevel level);

  /// Instead of Update: the field has nothing. What was built is kept.
  void Hide();

  /// Whether a coarse level stands in for some of the data.
  bool IsCoarse() const { return this->AtCoarse; }

  ///@{
  /// Goes on building: reads the next slab of the data, which must be intact, unless all are read
  /// (the fraction is 1). Where they have not been read, rays hit nothing, unless a coarse level
  /// stands in. What is traced must be selected again.
  void ReadSlab(int threads);
  double GetFractionRead() const;
  ///@}

  /// What went wrong when it was built, without harm to pictures; empty if nothing did.
  std::string GetWarning() const;

  /// The field of the input; null before the input is first traced.
  vtkIsosurfaceRayTracing::TracedField* GetField() const { return this->Field; }

  /// The size of its cells in its object space, about.
  double GetCellSize() const { return this->CellSize; }

  /// What of the field is visible: by blanking, ghosts, and the cropping of the mapper.
  vtkIsosurfaceRayTracing::Visibility FindVisible() const;

  /// From the object space of the field to the coordinates of the data.
  const vtkIsosurfaceRayTracing::Matrix4& GetPhysicalFromObject() const
  {
    return this->PhysicalFromObject;
  }

  /// The component of the volume property that gives the colours of the surfaces.
  int GetPropertyComponent() const { return this->PropertyComponent; }

  /// The components of the scalars that a cloud takes; none without data.
  const vtkIsosurfaceRayTraceClouds::Components& GetCloudComponents() const
  {
    return this->CloudComponents;
  }

  /// The colours of blocks, or of an array, by those of its values; null if surfaces are coloured
  /// by their isovalues. The input and the colours of values must outlive them.
  std::unique_ptr<vtkIsosurfaceRayTracing::HitColors> MakeColors(
    const vtkIsosurfaceRayTraceValueColors& colorsOfValues) const;

  /// Gives surfaces the opacities of the blocks that have their own.
  void SetOpacities(vtkIsosurfaceRayTracing::TraceRequest& request) const;

  /// The range of the scalars, from high to low if none is a number. Returns whether it is that of
  /// all: false if the input is a piece of others, or has no scalars.
  bool FindScalarRange(double range[2]) const;

  int GetNumberOfParts() const { return static_cast<int>(this->Parts.size()); }

  /// The part that has a hit.
  const vtkIsosurfaceRayTracePart& GetPart(const vtkIsosurfaceRayTracing::Hit& hit) const
  {
    return *this->Parts[static_cast<std::size_t>(hit.Member)];
  }

  /// The cell that a hit is in, and the point nearest to it, by their ids in the data.
  vtkIdType FindCell(
    const vtkIsosurfaceRayTracing::Hit& hit, vtkIsosurfaceRayTracing::Vector3& parametric) const
  {
    return this->GetPart(hit).FindCell(hit, parametric);
  }
  void MoveToWholeCell(const vtkIsosurfaceRayTracing::Hit& hit, vtkGenericCell* any,
    vtkIsosurfaceRayTracing::Vector3& parametric) const
  {
    this->GetPart(hit).MoveToWholeCell(hit, any, parametric);
  }
  vtkIdType FindPoint(const vtkIsosurfaceRayTracing::Hit& hit) const
  {
    return this->GetPart(hit).FindPoint(hit);
  }

  ///@{
  /// The block of composite data that has a point or a cell, whose number becomes that in the
  /// block; null if the input is not composite, or no block has it.
  const vtkIsosurfaceRayTraceLeaf* FindBlockOfPoint(vtkIdType& point) const
  {
    return this->IsComposite ? this->Leaves.FindLeafOfPoint(point) : nullptr;
  }
  const vtkIsosurfaceRayTraceLeaf* FindBlockOfCell(vtkIdType& cell) const
  {
    return this->IsComposite ? this->Leaves.FindLeafOfCell(cell) : nullptr;
  }
  ///@}
  vtkIdType GetNumberOfCells() const { return this->Leaves.GetNumberOfCells(); }
  vtkIdType GetNumberOfPoints() const { return this->Leaves.GetNumberOfPoints(); }

  /// Whether the arrays that are traced are still where they were, and as long. (An observer may
  /// have released their memory.)
  bool IsIntact(int threads) const;

  /// The objects that a picture of the input depends on, which exist as long as the list. Some may
  /// be null.
  std::shared_ptr<const std::vector<vtkSmartPointer<vtkObject>>> GetObjects();

private:
  using Part = vtkIsosurfaceRayTracePart;
  using PartList = std::vector<std::unique_ptr<Part>>;
  /// By their data: there may be very many of them. Those of the same data are in their order.
  using FormerParts = std::multimap<vtkDataSet*, std::unique_ptr<Part>>;

  std::string SelectLeaves(const vtkIsosurfaceRayTraceInputSettings& settings);
  std::string SelectCloudComponents(vtkVolumeProperty* property);
  std::string SelectColors(const vtkIsosurfaceRayTraceInputSettings& settings);
  std::string UpdateParts(const vtkIsosurfaceRayTraceInputSettings& settings,
    const vtkIsosurfaceRayTraceScalars& scalars);
  std::string SelectParts(const vtkIsosurfaceRayTraceInputSettings& settings,
    const vtkIsosurfaceRayTraceScalars& scalars);
  void AddAmr(const vtkIsosurfaceRayTraceInputSettings& settings,
    const vtkIsosurfaceRayTraceScalars& scalars, FormerParts& before,
    std::vector<vtkIsosurfaceRayTraceLeaf>& grids);
  std::string AddMesh(const vtkIsosurfaceRayTraceLeaf& leaf,
    const vtkIsosurfaceRayTraceInputSettings& settings, const vtkIsosurfaceRayTraceScalars& scalars,
    FormerParts& before);
  std::string AddGrid(const std::vector<vtkIsosurfaceRayTraceLeaf>& leaves,
    const vtkIsosurfaceRayTraceInputSettings& settings, const vtkIsosurfaceRayTraceScalars& scalars,
    FormerParts& before);
  void RemoveParts();
  bool ArePartsIntact(int threads) const;
  std::unique_ptr<vtkIsosurfaceRayTracing::HitColors> MakeColorsOfArray(
    const vtkIsosurfaceRayTraceValueColors& colorsOfValues) const;
  /// Whether the field is that of a part by itself. (Seamless ones have margins, which a set cuts.)
  bool IsLone() const { return this->Parts.size() == 1 && !this->Parts.front()->IsSeamless(); }

  vtkDataObject* GetData() const;

  vtkAbstractVolumeMapper* Mapper;
  int Connection;
  std::function<vtkIsosurfaceRayTraceInputSettings()> GetSettings;
  bool IsComposite = false;
  /// The field where nothing is selected.
  vtkIsosurfaceRayTracing::EmptyField Empty;
  vtkIsosurfaceRayTraceLeaves Leaves;
  vtkIsosurfaceRayTraceLeftOut LeftOut;
  PartList Parts;
  vtkCompositeDataDisplayAttributes* Attributes = nullptr;
  /// Those that are built at once, and not by the first ray: how many, and which have data that are
  /// still to be read.
  int NumberOfEagerParts = 0;
  std::vector<Part*> UnreadParts;
  bool AtCoarse = false;
  /// What of the leaves has changed since parts were last selected, and whether these are the same
  /// if nothing has; what else they were selected by.
  vtkIsosurfaceRayTraceLeaves::Change ChangeOfLeaves =
    vtkIsosurfaceRayTraceLeaves::Change::OfAnything;
  bool ArePartsKept = false;
  /// Those of the parts that are kept; else null.
  std::shared_ptr<const std::vector<vtkSmartPointer<vtkObject>>> Objects;
  int Component = 0;
  bool HasOtherComponents = false;
  vtkIsosurfaceRayTracing::ImageSettings ImageSettings;
  int PropertyComponent = 0;
  vtkIsosurfaceRayTraceClouds::Components CloudComponents;
  /// The colours of the surfaces, if they are those of an image; else null.
  vtkImageData* ColorImage = nullptr;
  vtkDataArray* ColorArray = nullptr;
  /// The number of its tuples.
  vtkIdType NumberOfColors = 0;

  /// That of the only part, or the set of those of all parts, which is kept while they are the
  /// same.
  vtkIsosurfaceRayTracing::TracedField* Field = nullptr;
  vtkIsosurfaceRayTracePartSet Set;
  /// Whether the set is that of the parts as they are.
  bool ArePlaced = false;
  vtkIsosurfaceRayTracing::Matrix4 PhysicalFromObject = { 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0,
    0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0 };
  double CellSize = 1.0;
};

VTK_ABI_NAMESPACE_END

#endif
