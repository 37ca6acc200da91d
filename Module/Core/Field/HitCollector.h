// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef HitCollector_h
#define HitCollector_h

#include "Field/TracedField.h"

#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// A ray ends where the surfaces it passed transmit less than this: a quarter of a step of an 8-bit
/// colour.
constexpr double NegligibleTransmittance = 1.0 / 1024.0;

/// Collects the hits of one ray, which come front to back, until no transmittance is left.
class HitCollector
{
public:
  /// Hits are appended.
  HitCollector(const TracedField& field, std::vector<Hit>& hits)
    : Field(&field)
    , Request(&field.GetRequest())
    , Hits(&hits)
  {
  }

  /// Adds a hit, if it is visible. Returns whether no transmittance is left behind it.
  bool Add(const Hit& hit)
  {
    if (!this->Request->Visible.IsConvex() &&
      !this->Request->Visible.Shows(hit, this->Field->GetPoint(hit)))
    {
      return false;
    }
    return this->AddVisible(hit);
  }

  /// The same for a hit that is known to be visible.
  bool AddVisible(const Hit& hit)
  {
    this->Hits->push_back(hit);
    this->Transmittance *= 1.0 - this->Request->GetOpacity(hit);
    return this->Transmittance < NegligibleTransmittance;
  }

private:
  const TracedField* Field;
  const TraceRequest* Request;
  std::vector<Hit>* Hits;
  double Transmittance = 1.0;
};

}

#endif
