// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Samples_h
#define Samples_h

#include <algorithm>
#include <chrono>
#include <ctime>
#include <vector>

namespace Benchmark
{

/// What repeating a measurement gave.
class Samples
{
public:
  void Add(double value)
  {
    this->Sorted.insert(std::upper_bound(this->Sorted.begin(), this->Sorted.end(), value), value);
    this->Sum += value;
  }

  bool IsEmpty() const { return this->Sorted.empty(); }
  int GetCount() const { return static_cast<int>(this->Sorted.size()); }
  double GetSum() const { return this->Sum; }
  /// There must be one.
  double GetMinimum() const { return this->Sorted.front(); }
  double GetMaximum() const { return this->Sorted.back(); }
  double GetMedian() const
  {
    const std::size_t half = this->Sorted.size() / 2;
    return this->Sorted.size() % 2 == 1 ? this->Sorted[half]
                                        : 0.5 * (this->Sorted[half - 1] + this->Sorted[half]);
  }

  /// The same in other units.
  Samples operator*(double factor) const
  {
    Samples scaled;
    for (const double value : this->Sorted)
    {
      scaled.Add(value * factor);
    }
    return scaled;
  }

private:
  std::vector<double> Sorted;
  double Sum = 0.0;
};

/// The wall-clock time of a call, in seconds.
template <typename Function>
double Measure(const Function& function)
{
  const auto start = std::chrono::steady_clock::now();
  function();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The processor time of a call on the calling thread, in seconds: other programs do not lengthen
/// it.
template <typename Function>
double MeasureProcessor(const Function& function)
{
  const auto read = []()
  {
    std::timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  };
  const double start = read();
  function();
  return read() - start;
}

/// Starts so many threads, which OpenMP keeps until others are asked for: whoever is measured first
/// with a number of threads would wait for them.
inline void StartThreads(int threads)
{
#pragma omp parallel num_threads(threads)
  {
  }
}

/// The seconds of a call that works on so many threads: on one, processor time.
template <typename Function>
double MeasureOn(int threads, const Function& function)
{
  StartThreads(threads);
  return threads == 1 ? MeasureProcessor(function) : Measure(function);
}

/// Whether a measurement that takes long should be repeated.
inline bool IsEnough(const Samples& samples, int repeats)
{
  constexpr double patience = 15.0;
  return samples.GetCount() >= repeats || samples.GetSum() > patience;
}

}

#endif
