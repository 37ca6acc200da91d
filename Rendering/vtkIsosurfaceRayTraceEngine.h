// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// What mappers that ray trace isosurfaces do, whatever kind of data they trace: drawing, casting,
// picking, pictures without a window; and what they keep between frames.

#ifndef vtkIsosurfaceRayTraceEngine_h
#define vtkIsosurfaceRayTraceEngine_h

#include "vtkIsosurfaceRayTraceFrame.h"       // for ivars
#include "vtkIsosurfaceRayTraceInputBounds.h" // for ivars
#include "vtkIsosurfaceRayTraceReporter.h"    // for ivars
#include "vtkIsosurfaceRayTraceRequest.h"     // for arguments
#include "vtkIsosurfaceRayTraceUse.h"         // for ivars
#include "vtkIsosurfaceRayTracingCompat.h"    // for VTK_ABI_NAMESPACE_BEGIN

#include "Field/TracedField.h"
#include "Picture/RenderSharedTiles.h"
#include "Picture/RenderTiles.h"

#include <functional> // for std::function
#include <memory>     // for std::unique_ptr
#include <string>     // for std::string

VTK_ABI_NAMESPACE_BEGIN

class vtkAbstractMapper;
class vtkAbstractVolumeMapper;
class vtkAlgorithm;
class vtkBoundingBox;
class vtkCamera;
class vtkCompositeDataDisplayAttributes;
class vtkDataArray;
class vtkDataObject;
class vtkDataSet;
class vtkFloatArray;
class vtkImageData;
class vtkIsosurfaceRayTraceHolder;
class vtkIsosurfaceRayTracePicture;
class vtkLightCollection;
class vtkPoints;
class vtkPolyData;
class vtkRenderWindow;
class vtkRenderer;
class vtkTable;
class vtkVolume;
class vtkWindow;
struct vtkIsosurfaceRayTraceSettings;

class vtkIsosurfaceRayTraceEngine
{
public:
  /// What a mapper tells about itself.
  struct Client
  {
    std::function<vtkIsosurfaceRayTraceSettings()> GetSettings;
    /// Makes an input of the mapper.
    vtkIsosurfaceRayTraceInputs::Maker NewInput;
    /// The volume that was set for a connection; null if none was.
    std::function<vtkVolume*(int connection)> GetConnectionVolume;
    /// Called with the distance between rays of the frame that begins.
    std::function<void(float)> SetImageSampleDistance;
    /// What to do where there is not enough memory, as sentences.
    const char* MemoryRemedy;
  };

  /// The view of a picture that needs no window. Without lights there is a headlight. The depths
  /// are those of what is drawn already, for each pixel; null where there is nothing. If the data
  /// are a piece of those of many processes, there may be connections without data.
  struct PictureView
  {
    vtkCamera* Camera;
    vtkLightCollection* Lights;
    int Width;
    int Height;
    vtkFloatArray* Depths;
    bool IsOfPiece = false;
  };

  /// The mapper owns the engine.
  vtkIsosurfaceRayTraceEngine(vtkAbstractVolumeMapper* mapper, Client client);
  ~vtkIsosurfaceRayTraceEngine();
  vtkIsosurfaceRayTraceEngine(const vtkIsosurfaceRayTraceEngine&) = delete;
  void operator=(const vtkIsosurfaceRayTraceEngine&) = delete;

  /// That of a mapper; null if the mapper has none.
  static vtkIsosurfaceRayTraceEngine* Of(vtkAbstractMapper* mapper);

  /// Updates the whole extent of the inputs of a mapper, in one piece, whatever other consumers
  /// have requested before.
  static void UpdateInputs(vtkAlgorithm* mapper);

  /// Updates the inputs of the mapper and finds the bounds of all that is visible, if there are
  /// several connections or composite data. Returns whether there are. The attributes of blocks may
  /// be null.
  bool FindBounds(vtkCompositeDataDisplayAttributes* attributes, double bounds[6]);

  ///@{
  /// See vtkIsosurfaceRayTraceMapper, which documents them.
  bool HasOnlyOpaqueSurfaces(vtkVolume* volume);
  int IntersectWithLine(vtkVolume* volume, const double p1[3], const double p2[3], double& t,
    double x[3], double pcoords[3], vtkIdType& cellId, double& isovalue, double normal[3]);
  bool CastRays(
    vtkVolume* volume, vtkPoints* origins, vtkDataArray* directions, vtkPolyData* output);
  bool FindSurfaceBounds(vtkVolume* volume, double bounds[6]);
  int PickPixel(vtkRenderer* renderer, vtkVolume* volume, int column, int row, double x[3],
    double pcoords[3], vtkIdType& cellId, double& isovalue, double normal[3]);
  bool RenderToImage(vtkVolume* volume, const PictureView& view, vtkImageData* output);
  bool RenderToFragments(vtkVolume* volume, const PictureView& view, vtkTable* output);
  bool RenderOwnTiles(vtkVolume* volume, const PictureView& view,
    const vtkIsosurfaceRayTracing::Sharing& sharing,
    vtkIsosurfaceRayTracing::MessageExchange& exchange,
    vtkIsosurfaceRayTracing::SharingCounts& counts, vtkImageData* output);
  vtkDataSet* FindBlock(vtkIdType cellId, vtkIdType& cellInBlock, unsigned int& flatIndex);
  void ReleaseGraphicsResources(vtkWindow* window);
  ///@}

  /// The connection that has a cell, which is numbered as for FindBlock.
  int FindConnection(vtkIdType cellId) const;

  /// The volume of a connection, or null.
  vtkVolume* GetConnectionVolume(int connection) const;

  /// What surfaces are, where a mapper draws nothing else.
  enum class Opacity
  {
    None,
    Opaque,
    Translucent
  };
  Opacity FindOpacity(vtkVolume* volume);

  /// Draws a frame into the window of the renderer. Returns the seconds that took; 0 if it is not
  /// complete.
  double Render(vtkRenderer* renderer, vtkVolume* volume);

  /// All zero before the input is first traced.
  vtkIsosurfaceRayTracing::FieldStatistics GetStatistics() const;

  /// Of the last frame, in seconds.
  double GetHierarchyTime() const { return this->HierarchyTime; }
  double GetGradientTime() const { return this->GradientTime; }
  const vtkIsosurfaceRayTracing::FrameTimes& GetTimes() const { return this->Times; }
  double GetDisplayTime() const { return this->DisplayTime; }
  int GetNumberOfAccumulatedFrames() const { return this->NumberOfAccumulatedFrames; }

private:
  /// Selects what to trace of inputs, one for each connection. Returns why they cannot be traced;
  /// empty if they can.
  std::string SelectInputs(vtkIsosurfaceRayTraceInputs& inputs,
    const vtkIsosurfaceRayTraceRequest::DrawnVolumes& volumes, bool isOfPiece = false) const;
  vtkIsosurfaceRayTraceRequest::DrawnVolumes FindVolumes(vtkVolume* drawn) const;
  bool AddHitsThroughFaces(vtkVolume* volume, int count, vtkBoundingBox& found);
  bool MayHit(vtkVolume* volume);
  /// Updates the input, and makes the request of a volume. Returns null, and reports why, if it
  /// cannot be traced.
  std::unique_ptr<vtkIsosurfaceRayTraceRequest> MakeRequest(const vtkIsosurfaceRayTraceUse& use,
    vtkVolume* volume, vtkIsosurfaceRayTraceLevel level, bool isOfPiece = false);
  /// The same with all samples read.
  std::unique_ptr<vtkIsosurfaceRayTraceRequest> MakeCompleteRequest(
    const vtkIsosurfaceRayTraceUse& use, vtkVolume* volume, bool isOfPiece = false);
  /// Reads samples that have not been read, slab by slab, for so long, with ProgressEvents. Returns
  /// whether what is traced has outlived these, and mayGoOn has not stopped it.
  bool ReadSamples(const vtkIsosurfaceRayTraceUse& use, const vtkIsosurfaceRayTraceRequest& request,
    double seconds, const std::function<bool()>& mayGoOn);
  ///@{
  /// What the processes of a picture must have in common; if they have not, that is reported.
  vtkIsosurfaceRayTracing::Agreement AgreeOnPicture(
    vtkIsosurfaceRayTracePicture& picture, vtkIsosurfaceRayTracing::MessageExchange& exchange);
  bool AgreeOnClouds(
    vtkIsosurfaceRayTracePicture& picture, vtkIsosurfaceRayTracing::MessageExchange& exchange);
  ///@}
  /// Whether a view has a depth for each pixel, or none; if not, that is reported.
  bool HasFittingDepths(const char* name, const PictureView& view) const;
  template <typename Trace, typename Write>
  bool RenderPicture(const char* name, vtkVolume* volume, const PictureView& view,
    vtkDataObject* output, const Trace& trace, const Write& write);
  /// Draws a frame. Returns whether it is complete.
  bool DrawFrame(const vtkIsosurfaceRayTraceUse& use, const vtkIsosurfaceRayTraceRequest& request,
    const vtkIsosurfaceRayTraceHolder& holder);
  /// Sends an event of a use to observers, unless one of them began it. Returns whether what is
  /// traced has outlived it.
  bool SendEvent(const vtkIsosurfaceRayTraceUse& use, const vtkIsosurfaceRayTraceRequest& request,
    unsigned long event, double* progress);
  /// The same for the ProgressEvent of reading samples.
  bool SendProgressOfReading(
    const vtkIsosurfaceRayTraceUse& use, const vtkIsosurfaceRayTraceRequest& request);
  /// Whether the window wants to abort the frame, or its observers have made it impossible.
  bool CheckAbort(const vtkIsosurfaceRayTraceRequest& request, vtkRenderWindow* window);
  /// Whether what is traced has outlived the observers of an event; if not, that is reported.
  bool IsIntact(const vtkIsosurfaceRayTraceRequest& request);

  vtkAbstractVolumeMapper* Mapper;
  Client TheClient;
  vtkIsosurfaceRayTraceUseState Uses;
  vtkIsosurfaceRayTraceFrame Frame;
  vtkIsosurfaceRayTraceReporter Reporter;
  vtkIsosurfaceRayTraceInputBounds Bounds;
  double HierarchyTime = 0.0;
  double GradientTime = 0.0;
  vtkIsosurfaceRayTracing::FrameTimes Times;
  double DisplayTime = 0.0;
  int NumberOfAccumulatedFrames = 0;
};

VTK_ABI_NAMESPACE_END

#endif
