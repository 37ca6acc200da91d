// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CloudTransfer_h
#define CloudTransfer_h

#include "Field/CloudSource.h"
#include "Kernels/CloudTile.h"
#include "Math/Vector.h"

#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// What a cloud looks like where it has a value.
struct CloudNode
{
  double Value;
  /// For a unit of length in the world; not negative.
  double Attenuation;
  Vector3 Color;
};

/// The transfer functions of a cloud: linear between nodes.
class CloudTransfer
{
public:
  /// The nodes are in order, and there is at least one. Between two at one value the functions
  /// jump; beyond the first and the last they are constant.
  explicit CloudTransfer(const std::vector<CloudNode>& nodes);
  CloudTransfer(const CloudTransfer&) = delete;
  void operator=(const CloudTransfer&) = delete;

  const TransferPieces& GetPieces() const { return this->View; }

  /// The values with an attenuation, in order: all that light is lost in, or comes from.
  ValueIntervals FindShown() const;

  /// The colour and the attenuation of a value.
  CloudNode Get(double value) const;

private:
  void AddPiece(double low, double high, const CloudNode& from, const CloudNode& to);
  void FillBins(double first, double last);

  std::vector<TransferPiece> Pieces;
  std::vector<int> FirstInBin;
  TransferPieces View{};
};

}

#endif
