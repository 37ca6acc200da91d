// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef HardCases_Tally_h
#define HardCases_Tally_h

#include "Scenes.h"

#include <string>

namespace HardCases
{

/// The guaranteed accuracy of a solver.
struct Guarantee
{
  RootSolver Solver;
  /// So much rounding may move values, in units of the largest difference between a corner of the
  /// cell and the isovalue. Where an extremum of the interpolant is nearer to the isovalue than
  /// this, a ray may have or lack the hits there.
  double Band;
  /// The distance between a hit and the exact one, in cells, wherever the band leaves it.
  double Accuracy;
  /// In radians.
  double Normal;
};

/// In double, 32 roundings of the interpolant and 16 for each cell of the longest edge, by which
/// the position of the ray is rounded.
Guarantee RobustGuarantee(const Index& dimensions);

/// Counts how the hits of rays compare to those of the oracle; prints a row of a table.
class Tally
{
public:
  explicit Tally(std::string name);

  /// Checks all hits of the lines, found by the tracer with the solver Robust.
  void Check(const Field& field, double isovalue, const std::vector<Line>& lines,
    ScalarType type = ScalarType::Float64);

  /// Checks hits that were found before.
  void CheckHits(const Field& field, double isovalue, const std::vector<Line>& lines,
    const RayHits& hits, const Guarantee& guarantee, Tracer& tracer);

  /// For tests that count by themselves.
  void Count(std::size_t rays, std::size_t hits, std::size_t misses, std::size_t falseHits);
  void Expect(const Guarantee& guarantee)
  {
    this->Accuracy = guarantee.Accuracy;
    this->Normal = guarantee.Normal;
  }
  void AddError(double error) { this->Errors.push_back(error); }
  void Note(const std::string& note);
  void CheckNormals(bool check) { this->AreNormalsChecked = check; }

  /// Prints the row, and reports failures to GoogleTest.
  void Report();

  std::size_t GetFailures() const { return this->Failures; }

private:
  struct LocatedHit;
  struct Interval;
  /// What the hits of a line are checked against.
  struct Context;

  static LocatedHit Crossing(const Tracer& tracer, const Line& line, const Hit& hit);
  static double Distance(
    const Context& context, const LocatedHit& located, const Oracle::Quad& root);
  static bool IsNear(const Context& context, const LocatedHit& located, const Oracle::Quad& root);
  static bool IsWellConditioned(
    const Context& context, const Index& cell, const Oracle::Quad& root);
  static bool IsExplained(const Context& context, const LocatedHit& located);
  static bool IsNearRoot(const Context& context, const std::vector<Oracle::Piece>& pieces,
    const Interval& interval, const LocatedHit& located);

  std::vector<Interval> FindIntervals(const std::vector<Oracle::Piece>& pieces, double band) const;
  void CheckLine(const Field& field, double isovalue, const Line& line, const Hit* first,
    const Hit* last, const Guarantee& guarantee, Tracer& tracer);
  void Measure(
    const Context& context, const std::vector<Oracle::Piece>& pieces, const Interval& interval);
  void MeasureRoot(const Context& context, const Oracle::Piece& piece, const LocatedHit& located);
  void PrintFailure(const char* what, double isovalue, const Line& line, const Oracle::Quad& t);

  std::string Name;
  std::string Notes;
  std::size_t Rays = 0;
  std::size_t Hits = 0;
  std::size_t Misses = 0;
  std::size_t FalseHits = 0;
  std::size_t InBandRays = 0;
  std::size_t InBandHits = 0;
  /// Hits that no double can represent to the guaranteed accuracy, and their largest error.
  std::size_t IllConditioned = 0;
  double LargestIllConditionedError = 0.0;
  /// Hits whose error exceeds what the band explains.
  std::size_t Unexplained = 0;
  std::vector<double> Errors;
  double LargestAngle = 0.0;
  bool AreNormalsChecked = true;
  double Accuracy = 0.0;
  double Normal = 0.0;
  std::size_t Failures = 0;
};

}

#endif
