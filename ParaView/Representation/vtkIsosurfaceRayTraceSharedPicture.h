// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// What the representations of a view show together where neither the pieces of the processes nor
// the representations have an order: one picture, composited pixel by pixel, which process 0 shows.

#ifndef vtkIsosurfaceRayTraceSharedPicture_h
#define vtkIsosurfaceRayTraceSharedPicture_h

#include "vtkBoundingBox.h" // for Member
#include "vtkIsosurfacePicture.h"
#include "vtkIsosurfaceRayTraceSceneDepths.h" // for ivars
#include "vtkIsosurfaceRayTracingCompat.h"    // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkNew.h"                           // for ivars
#include "vtkSmartPointer.h"                  // for Of
#include "vtkWeakPointer.h"                   // for ivars

#include <vector> // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkImageData;
class vtkInformation;
class vtkIsosurfaceRayTraceCompositor;
class vtkPVDataRepresentation;
class vtkPVRenderView;
class vtkRenderer;
class vtkVolume;

class vtkIsosurfaceRayTraceSharedPicture : public vtkIsosurfacePicture
{
public:
  /// What a representation shows.
  struct Member
  {
    vtkPVDataRepresentation* Representation;
    vtkVolume* Volume;
    /// Of its piece in each process, without ghosts, as they are shown.
    std::vector<vtkBoundingBox> Bounds;
    bool IsOpaque = true;
    bool HasData = false; // in this process
  };

  static vtkIsosurfaceRayTraceSharedPicture* New();
  vtkTypeMacro(vtkIsosurfaceRayTraceSharedPicture, vtkIsosurfacePicture);

  /// The one of a view.
  static vtkSmartPointer<vtkIsosurfaceRayTraceSharedPicture> Of(vtkPVRenderView* view);

  ///@{
  /// A member stays where it is until it is removed. The last one takes the picture from the view.
  void Add(Member* member);
  void Remove(Member* member);
  ///@}

  /// Tells the view, which updates, the bounds of all members, by which it composites in order what
  /// each process draws. To be called whenever those of a member are new.
  void TellBounds(vtkInformation* request);

  /// Whether the picture stands for all volumes in the frame that begins or is drawn.
  bool IsUsed() const { return this->IsInUse; }

  double* GetBounds() override;
  int RenderOpaqueGeometry(vtkViewport* viewport) override;
  int RenderVolumetricGeometry(vtkViewport* viewport) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  vtkIsosurfaceRayTraceSharedPicture();
  ~vtkIsosurfaceRayTraceSharedPicture() override;

private:
  vtkIsosurfaceRayTraceSharedPicture(const vtkIsosurfaceRayTraceSharedPicture&) = delete;
  void operator=(const vtkIsosurfaceRayTraceSharedPicture&) = delete;

  std::vector<Member*> FindVisibleMembers() const;
  vtkBoundingBox FindBounds() const;
  bool AreUnordered() const;
  void Begin();
  void Make();

  vtkWeakPointer<vtkPVRenderView> View;
  unsigned long Observer = 0;
  std::vector<Member*> Members;
  bool IsInUse = false;
  vtkNew<vtkIsosurfaceRayTraceCompositor> Compositor;
  vtkIsosurfaceRayTraceSceneDepths Depths;
  vtkNew<vtkImageData> Image;
  double Bounds[6];
  int Size[2] = { 0, 0 }; // in pixels of the viewport
};

VTK_ABI_NAMESPACE_END

#endif
