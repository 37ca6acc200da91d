// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef MessageExchange_h
#define MessageExchange_h

#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// What processes that make one picture send to each other. Used by one thread.
class MessageExchange
{
public:
  using Message = std::vector<unsigned char>;

  virtual ~MessageExchange() = default;

  virtual int GetNumberOfProcesses() const = 0;
  /// The number of this process, from 0 on.
  virtual int GetProcess() const = 0;

  /// Replaces each number by the largest that any process has in its place. All must call it.
  virtual void FindLargest(int* numbers, int count) = 0;

  /// Whether the last message to a process is on its way, so that the next may be sent.
  virtual bool IsSent(int process) = 0;

  /// Begins to send a message, which is moved from. The last one to the process must be sent.
  virtual void Send(int process, Message& message) = 0;

  /// Takes a message if one is there; returns whether one was. Those of a process come in the order
  /// that they were sent in.
  virtual bool Receive(int& process, Message& message) = 0;
};

}

#endif
