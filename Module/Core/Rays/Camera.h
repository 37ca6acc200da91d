// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Camera_h
#define Camera_h

#include "Math/Vector.h"
#include "Rays/PixelRays.h"

namespace vtkIsosurfaceRayTracing
{

/// A camera in the object space of a volume: any projection that a 4 x 4 matrix describes.
///
/// The matrices lead straight from object space to clip coordinates, so a volume far from the
/// origin of the world loses nothing.
class Camera
{
public:
  /// A ray through a pixel, in object space, with t = 0 at the near plane. The length of its
  /// direction is such that t is the same in every object space of one view.
  struct PixelRay
  {
    Vector3 Origin;
    Vector3 Direction;
    /// The far plane, or whatever lies before it.
    double End;
  };

  Camera() = default;

  /// The matrices must be inverse to each other. Width and height are those of the viewport, in
  /// pixels; not whole numbers if the last pixels reach beyond it.
  Camera(const Matrix4& clipFromObject, const Matrix4& objectFromClip,
    const Matrix4& worldFromObject, double width, double height)
    : ClipFromObject(clipFromObject)
    , ObjectFromClip(objectFromClip)
    , WorldFromObject(worldFromObject)
    , Width(width)
    , Height(height)
  {
  }

  /// The ray through the centre of a pixel, up to a depth in [0, 1] as in the depth buffer.
  PixelRay GetRay(int column, int row, double depth) const
  {
    double origin[3];
    double direction[3];
    double end;
    MakePixelRays<double>(this->ObjectFromClip.data(), this->Width, this->Height, column, row,
      depth, origin, direction, end);
    return { { origin[0], origin[1], origin[2] }, { direction[0], direction[1], direction[2] },
      end };
  }

  /// The depth in [0, 1] of a point in object space.
  double GetDepth(const Vector3& point) const
  {
    return GetPixelDepth(this->ClipFromObject.data(), point.data());
  }

  /// The same view by rays through other points of the pixels: offset from the centre, in pixels,
  /// to the right and upwards.
  Camera Shifted(double columns, double rows) const
  {
    const double x = columns * (2.0 / this->Width);
    const double y = rows * (2.0 / this->Height);
    Camera shifted = *this;
    for (std::size_t i = 0; i < 4; ++i)
    {
      shifted.ClipFromObject[i] -= x * this->ClipFromObject[12 + i];
      shifted.ClipFromObject[4 + i] -= y * this->ClipFromObject[12 + i];
      shifted.ObjectFromClip[4 * i + 3] +=
        x * this->ObjectFromClip[4 * i] + y * this->ObjectFromClip[4 * i + 1];
    }
    return shifted;
  }

  const Matrix4& GetClipFromObject() const { return this->ClipFromObject; }
  const Matrix4& GetObjectFromClip() const { return this->ObjectFromClip; }
  const Matrix4& GetWorldFromObject() const { return this->WorldFromObject; }
  double GetWidth() const { return this->Width; }
  double GetHeight() const { return this->Height; }

private:
  Matrix4 ClipFromObject;
  Matrix4 ObjectFromClip;
  Matrix4 WorldFromObject;
  double Width = 0.0;
  double Height = 0.0;
};

}

#endif
