// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The messages of processes that draw a cloud together, by MPI.

#ifndef vtkIsosurfaceRayTraceMPIExchange_h
#define vtkIsosurfaceRayTraceMPIExchange_h

#include "vtkCommunicator.h"
#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkMPICommunicator.h"
#include "vtkMPIController.h"

#include "Picture/MessageExchange.h"

#include <algorithm> // for std::copy
#include <cstddef>   // for std::size_t
#include <utility>   // for std::move
#include <vector>    // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkIsosurfaceRayTraceMPIExchange final : public vtkIsosurfaceRayTracing::MessageExchange
{
public:
  /// The controller must outlive the exchange, whose messages must all be sent when it ends.
  explicit vtkIsosurfaceRayTraceMPIExchange(vtkMPIController* controller)
    : Controller(controller)
    , Sending(static_cast<std::size_t>(controller->GetNumberOfProcesses()))
  {
  }

  int GetNumberOfProcesses() const override { return this->Controller->GetNumberOfProcesses(); }
  int GetProcess() const override { return this->Controller->GetLocalProcessId(); }

  void FindLargest(int* numbers, int count) override
  {
    std::vector<int> largest(static_cast<std::size_t>(count));
    this->Controller->AllReduce(numbers, largest.data(), count, vtkCommunicator::MAX_OP);
    std::copy(largest.begin(), largest.end(), numbers);
  }

  bool IsSent(int process) override
  {
    SentMessage& sent = this->Sending[static_cast<std::size_t>(process)];
    sent.IsUnderWay = sent.IsUnderWay && sent.Request.Test() == 0;
    return !sent.IsUnderWay;
  }

  void Send(int process, Message& message) override
  {
    SentMessage& sent = this->Sending[static_cast<std::size_t>(process)];
    sent.Bytes = std::move(message);
    sent.IsUnderWay = true;
    this->Controller->NoBlockSend(reinterpret_cast<const char*>(sent.Bytes.data()),
      static_cast<int>(sent.Bytes.size()), process, Tag, sent.Request);
  }

  bool Receive(int& process, Message& message) override
  {
    int isThere = 0;
    int size = 0;
    const char type = 0;
    this->Controller->Iprobe(
      vtkMultiProcessController::ANY_SOURCE, Tag, &isThere, &process, &type, &size);
    if (!isThere)
    {
      return false;
    }
    message.resize(static_cast<std::size_t>(size));
    this->Controller->Receive(reinterpret_cast<char*>(message.data()), size, process, Tag);
    return true;
  }

private:
  /// While a message is under way, the next one is made: there are two buffers for each process.
  struct SentMessage
  {
    Message Bytes;
    vtkMPICommunicator::Request Request;
    bool IsUnderWay = false;
  };

  static constexpr int Tag = 16180;

  vtkMPIController* Controller;
  std::vector<SentMessage> Sending;
};

VTK_ABI_NAMESPACE_END

#endif
