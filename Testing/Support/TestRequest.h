// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef TestRequest_h
#define TestRequest_h

#include "Image/ImageField.h"

namespace vtkIsosurfaceRayTracing
{

/// All that is set on an image before it is traced, in one.
struct TestRequest : TraceRequest
{
  using TraceRequest::TraceRequest;

  /// See ImageField::SetPlanes.
  const UnevenPlanes* Planes = nullptr;
  /// See Execution.
  const Kernels* PacketKernels = &GetBestKernels();
  MemoryBudget Budget;
};

inline void Select(ImageField& field, const TestRequest& request, int threads)
{
  field.SetPlanes(request.Planes);
  field.Select(request, { threads, request.PacketKernels }, request.Budget);
}

}

#endif
