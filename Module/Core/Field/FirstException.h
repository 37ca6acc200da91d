// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef FirstException_h
#define FirstException_h

#include <atomic>
#include <exception>

namespace vtkIsosurfaceRayTracing
{

/// Carries an exception out of a parallel region of OpenMP, which none may leave by itself: the
/// first that any thread meets.
class FirstException
{
public:
  /// Calls a function; not any more once there is an exception.
  template <typename Function>
  void Guard(const Function& function) noexcept
  {
    if (this->IsThere.load(std::memory_order_relaxed))
    {
      return;
    }
    try
    {
      function();
    }
    catch (...)
    {
      if (!this->IsThere.exchange(true))
      {
        this->Exception = std::current_exception();
      }
    }
  }

  /// To be called behind the parallel region.
  void Rethrow() const
  {
    if (this->Exception)
    {
      std::rethrow_exception(this->Exception);
    }
  }

private:
  std::atomic<bool> IsThere{ false };
  std::exception_ptr Exception;
};

}

#endif
