// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Camera_h
#define Camera_h

#include "Math/Vector.h"

#include <limits>

namespace vtkIsosurfaceRayTracing
{

/// A camera as seen from the index space of a volume: any projection that a 4 x 4 matrix describes.
///
/// The matrices lead straight from index space to clip coordinates, so a volume far from the origin
/// of the world loses nothing.
class Camera
{
public:
  /// A ray through a pixel, in index space, with t = 0 at the near plane. The direction has
  /// whatever length the matrix gives it: nobody asks for the t of a pixel's hit.
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
  Camera(const Matrix4& clipFromIndex, const Matrix4& indexFromClip, const Matrix4& worldFromIndex,
    double width, double height)
    : ClipFromIndex(clipFromIndex)
    , IndexFromClip(indexFromClip)
    , WorldFromIndex(worldFromIndex)
    , Width(width)
    , Height(height)
  {
  }

  /// The ray through the centre of a pixel, up to a depth in [0, 1] as in the depth buffer.
  PixelRay GetRay(int column, int row, double depth) const
  {
    // The line through the pixel has homogeneous points a + z b, where z is the clip coordinate, -1
    // at the near plane and 1 at the far plane. Its direction, b wa - a wb, is found without going
    // to the far plane, which may be very far.
    const Matrix4& m = this->IndexFromClip;
    const double x = (column + 0.5) * (2.0 / this->Width) - 1.0;
    const double y = (row + 0.5) * (2.0 / this->Height) - 1.0;
    const Vector3 a = { m[0] * x + m[1] * y + m[3], m[4] * x + m[5] * y + m[7],
      m[8] * x + m[9] * y + m[11] };
    const Vector3 b = { m[2], m[6], m[10] };
    const double wa = m[12] * x + m[13] * y + m[15];
    const double wb = m[14];
    const double wNear = wa - wb;
    const double z = 2.0 * depth - 1.0;
    const double end = (z + 1.0) / ((wa + z * wb) * wNear);
    return { (a - b) * (1.0 / wNear), b * wa - a * wb,
      end >= 0.0 ? end : std::numeric_limits<double>::infinity() };
  }

  /// The depth in [0, 1] of a point in index space.
  double GetDepth(const Vector3& point) const
  {
    const Matrix4& m = this->ClipFromIndex;
    const double z = m[8] * point[0] + m[9] * point[1] + m[10] * point[2] + m[11];
    const double w = m[12] * point[0] + m[13] * point[1] + m[14] * point[2] + m[15];
    return 0.5 * z / w + 0.5;
  }

  /// The same view by rays that go through other places of their pixels: so many pixels to the
  /// right of the centre and above it.
  Camera Shifted(double columns, double rows) const
  {
    const double x = columns * (2.0 / this->Width);
    const double y = rows * (2.0 / this->Height);
    Camera shifted = *this;
    for (std::size_t i = 0; i < 4; ++i)
    {
      shifted.ClipFromIndex[i] -= x * this->ClipFromIndex[12 + i];
      shifted.ClipFromIndex[4 + i] -= y * this->ClipFromIndex[12 + i];
      shifted.IndexFromClip[4 * i + 3] +=
        x * this->IndexFromClip[4 * i] + y * this->IndexFromClip[4 * i + 1];
    }
    return shifted;
  }

  const Matrix4& GetClipFromIndex() const { return this->ClipFromIndex; }
  const Matrix4& GetIndexFromClip() const { return this->IndexFromClip; }
  const Matrix4& GetWorldFromIndex() const { return this->WorldFromIndex; }
  double GetWidth() const { return this->Width; }
  double GetHeight() const { return this->Height; }

private:
  Matrix4 ClipFromIndex;
  Matrix4 IndexFromClip;
  Matrix4 WorldFromIndex;
  double Width = 0.0;
  double Height = 0.0;
};

}

#endif
