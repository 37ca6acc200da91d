// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CloudMedium_h
#define CloudMedium_h

#include "Picture/CloudTransfer.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// What a cloud is made of: the transfer functions of its components, and how these are combined;
/// see MixedTransfers.
class CloudMedium
{
public:
  using Nodes = std::vector<CloudNode>;

  /// Of one component, or of up to MaximumCloudComponents.
  explicit CloudMedium(const Nodes& nodes)
    : CloudMedium({ nodes }, true)
  {
  }
  CloudMedium(const std::vector<Nodes>& ofComponents, bool areIndependent)
  {
    this->Mixed.Components = static_cast<int>(ofComponents.size());
    this->Mixed.AreIndependent = areIndependent;
    for (std::size_t i = 0; i < ofComponents.size(); ++i)
    {
      this->Transfers.push_back(std::make_unique<CloudTransfer>(ofComponents[i]));
      this->Mixed.Transfers[i] = &this->Transfers[i]->GetPieces();
    }
  }

  /// Lights the cloud, if there is any material: one for each component if they are independent,
  /// else one, with the gradient of the last component.
  void SetMaterials(const std::vector<CloudMaterial>& materials)
  {
    this->Mixed.Gradients = static_cast<int>(materials.size());
    std::copy(materials.begin(), materials.end(), this->Mixed.Materials);
  }

  const MixedTransfers& GetMixed() const { return this->Mixed; }

  /// The values of each component that light is lost in, or comes from.
  std::vector<ValueIntervals> FindShown() const
  {
    std::vector<ValueIntervals> shown;
    for (const std::unique_ptr<CloudTransfer>& transfer : this->Transfers)
    {
      shown.push_back(transfer->FindShown());
    }
    return shown;
  }

private:
  std::vector<std::unique_ptr<CloudTransfer>> Transfers;
  MixedTransfers Mixed{};
};

}

#endif
