// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Picture/CloudTransfer.h"

#include "Math/Arithmetic.h"

#include <algorithm>
#include <cstddef>

namespace vtkIsosurfaceRayTracing
{

//------------------------------------------------------------------------------
CloudTransfer::CloudTransfer(const std::vector<CloudNode>& nodes)
{
  const CloudNode& first = nodes.front();
  const CloudNode& last = nodes.back();
  this->AddPiece(-Infinity, first.Value, first, first);
  for (std::size_t i = 1; i < nodes.size(); ++i)
  {
    if (nodes[i - 1].Value < nodes[i].Value)
    {
      this->AddPiece(nodes[i - 1].Value, nodes[i].Value, nodes[i - 1], nodes[i]);
    }
  }
  this->AddPiece(last.Value, Infinity, last, last);
  this->FillBins(first.Value, last.Value);
  this->View.Pieces = this->Pieces.data();
  this->View.FirstInBin = this->FirstInBin.data();
}

//------------------------------------------------------------------------------
void CloudTransfer::AddPiece(double low, double high, const CloudNode& from, const CloudNode& to)
{
  const double atLow[4] = { from.Attenuation, from.Color[0], from.Color[1], from.Color[2] };
  const double atHigh[4] = { to.Attenuation, to.Color[0], to.Color[1], to.Color[2] };
  TransferPiece piece{};
  piece.Low = low;
  piece.High = high;
  piece.Anchor = from.Value;
  piece.Scale = 1.0 / (high - low);
  for (std::size_t i = 0; i < 4; ++i)
  {
    const double change = atHigh[i] - atLow[i];
    piece.AtAnchor[i] = atLow[i];
    piece.Slope[i] = change != 0.0 ? change / (high - low) : 0.0;
    piece.Functions[i] = static_cast<float>(atLow[i]);
    piece.Functions[4 + i] = static_cast<float>(change);
  }
  this->Pieces.push_back(piece);
}

//------------------------------------------------------------------------------
/// Values are found from the first piece of their bin on.
void CloudTransfer::FillBins(double first, double last)
{
  const int bins = last > first ? 1024 : 1;
  this->View.Bins = bins;
  this->View.First = first;
  this->View.BinsPerUnit = last > first ? bins / (last - first) : 0.0;
  int piece = 0;
  for (int bin = 0; bin < bins; ++bin)
  {
    // One bin earlier than need be: rounding may put a value into the next one.
    const double low = bin < 2 ? -Infinity : first + (bin - 1) / this->View.BinsPerUnit;
    while (this->Pieces[static_cast<std::size_t>(piece)].High < low)
    {
      ++piece;
    }
    this->FirstInBin.push_back(piece);
  }
}

//------------------------------------------------------------------------------
ValueIntervals CloudTransfer::FindShown() const
{
  ValueIntervals shown;
  for (const TransferPiece& piece : this->Pieces)
  {
    // Linear: it is anywhere if it is at an end. A piece without an end is constant.
    const double reach = piece.Slope[0] != 0.0 ? piece.High - piece.Low : 0.0;
    if (piece.AtAnchor[0] <= 0.0 && piece.AtAnchor[0] + piece.Slope[0] * reach <= 0.0)
    {
      continue;
    }
    if (shown.empty() || shown.back().High < piece.Low)
    {
      shown.push_back({ piece.Low, piece.Low });
    }
    shown.back().High = piece.High;
  }
  return shown;
}

//------------------------------------------------------------------------------
CloudNode CloudTransfer::Get(double value) const
{
  const auto piece = std::find_if(this->Pieces.begin(), this->Pieces.end() - 1,
    [value](const TransferPiece& candidate) { return value <= candidate.High; });
  double functions[4];
  for (std::size_t i = 0; i < 4; ++i)
  {
    functions[i] = std::max(piece->AtAnchor[i] + piece->Slope[i] * (value - piece->Anchor), 0.0);
  }
  return { value, functions[0], { functions[1], functions[2], functions[3] } };
}

}
