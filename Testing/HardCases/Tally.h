// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef HardCases_Tally_h
#define HardCases_Tally_h

#include "Scenes.h"

#include <string>

namespace HardCases
{

/// What a solver promises.
struct Promise
{
  RootSolver Solver;
  /// Where the interpolant comes nearer to the isovalue than this without need, in units of the
  /// largest difference between a corner of the cell and the isovalue, a ray may be judged either
  /// way. So much rounding moves values.
  double Band;
  /// The distance between a hit and the exact one, in cells, wherever the band leaves it.
  double Accuracy;
  /// In radians.
  double Normal;
};

/// In double, 32 roundings of the interpolant and 16 for each cell of the longest edge, by which
/// the place of the ray is rounded.
Promise RobustPromise(const Index& dimensions);

/// Counts how the hits of rays compare to those of the oracle; prints a row of a table.
class Tally
{
public:
  explicit Tally(std::string name);

  /// Judges all hits of the lines, found by the tracer with the solver Robust.
  void Try(const Field& field, double isovalue, const std::vector<Line>& lines,
    ScalarType type = ScalarType::Float64);

  /// Judges hits that were found before.
  void Judge(const Field& field, double isovalue, const std::vector<Line>& lines,
    const RayHits& hits, const Promise& promise, Tracer& tracer);

  /// For tests that count by themselves.
  void Count(std::size_t rays, std::size_t hits, std::size_t misses, std::size_t inventions);
  void Expect(const Promise& promise)
  {
    this->Accuracy = promise.Accuracy;
    this->Normal = promise.Normal;
  }
  void AddError(double error) { this->Errors.push_back(error); }
  void Note(const std::string& note);
  void CheckNormals(bool check) { this->AreNormalsChecked = check; }

  /// Prints the row, and tells GoogleTest what is wrong.
  void Report();

  std::size_t GetInBandRays() const { return this->InBandRays; }
  std::size_t GetInBandHits() const { return this->InBandHits; }
  std::size_t GetHits() const { return this->Hits; }

private:
  struct Placed;
  struct Interval;
  /// What was asked of whom.
  struct Question;

  static Placed Crossing(const Tracer& tracer, const Line& line, const Hit& hit);
  static double Distance(const Question& question, const Placed& placed, const Oracle::Quad& root);
  static bool IsNear(const Question& question, const Placed& placed, const Oracle::Quad& root);
  static bool IsWellConditioned(
    const Question& question, const Index& cell, const Oracle::Quad& root);
  static bool IsExplained(const Question& question, const Placed& placed);
  static bool IsNearRoot(const Question& question, const std::vector<Oracle::Piece>& pieces,
    const Interval& interval, const Placed& placed);

  std::vector<Interval> FindIntervals(const std::vector<Oracle::Piece>& pieces, double band) const;
  void JudgeLine(const Field& field, double isovalue, const Line& line, const Hit* first,
    const Hit* last, const Promise& promise, Tracer& tracer);
  void Measure(
    const Question& question, const std::vector<Oracle::Piece>& pieces, const Interval& interval);
  void MeasureRoot(const Question& question, const Oracle::Piece& piece, const Placed& placed);
  void Complain(const char* what, double isovalue, const Line& line, const Oracle::Quad& t);

  std::string Name;
  std::string Notes;
  std::size_t Rays = 0;
  std::size_t Hits = 0;
  std::size_t Misses = 0;
  std::size_t Inventions = 0;
  std::size_t InBandRays = 0;
  std::size_t InBandHits = 0;
  /// Hits that no double can place to the accuracy promised, and how far off they are.
  std::size_t IllConditioned = 0;
  double LargestIllConditionedError = 0.0;
  /// Hits that are off by more than the band explains.
  std::size_t Unexplained = 0;
  std::vector<double> Errors;
  double LargestAngle = 0.0;
  bool AreNormalsChecked = true;
  double Accuracy = 0.0;
  double Normal = 0.0;
  std::size_t Complaints = 0;
};

}

#endif
