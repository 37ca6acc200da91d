// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Fragments compared with the definition of the operator "over", back to front in extended
// precision.

#include "Picture/Compositor.h"
#include "RandomNumbers.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

Fragment RandomFragment(RandomNumbers& random, double opacity)
{
  Vector3 color;
  for (double& channel : color)
  {
    channel = random.Uniform(0.0, opacity);
  }
  return { random.Uniform(0.0, 10.0), color, opacity,
    static_cast<float>(random.Uniform(0.0, 1.0)) };
}

/// Red, green, blue and opacity, from the last fragment to the first.
std::vector<long double> BackToFront(const std::vector<Fragment>& fragments)
{
  std::vector<long double> rgba(4, 0.0L);
  for (auto fragment = fragments.rbegin(); fragment != fragments.rend(); ++fragment)
  {
    const auto opacity = static_cast<long double>(fragment->Opacity);
    for (std::size_t k = 0; k < 3; ++k)
    {
      rgba[k] = static_cast<long double>(fragment->Color[k]) + (1.0L - opacity) * rgba[k];
    }
    rgba[3] = opacity + (1.0L - opacity) * rgba[3];
  }
  return rgba;
}

/// The number of the first ones that are composited: none is behind others that let less than a
/// 1024th of the light through.
std::size_t CountSeen(const std::vector<Fragment>& fragments)
{
  std::size_t count = 0;
  for (long double left = 1.0L; count < fragments.size() && left >= 1.0L / 1024.0L; ++count)
  {
    left *= 1.0L - static_cast<long double>(fragments[count].Opacity);
  }
  return count;
}

//------------------------------------------------------------------------------
TEST(Compositor, LeavesAPixelWithoutFragmentsEmpty)
{
  const CompositedPixel pixel = Composite(nullptr, 0);
  for (const std::uint8_t channel : pixel.Rgba)
  {
    EXPECT_EQ(channel, 0);
  }
  EXPECT_EQ(pixel.Depth, PixelWithoutDepth);
}

//------------------------------------------------------------------------------
TEST(Compositor, CompositesFrontToBackAsOverDoesBackToFront)
{
  RandomNumbers random(4711);
  for (int run = 0; run < 20000; ++run)
  {
    std::vector<Fragment> fragments;
    const int count = random.Integer(1, 6);
    for (int i = 0; i < count; ++i)
    {
      fragments.push_back(RandomFragment(random, random.Uniform(0.05, 0.95)));
    }
    const CompositedPixel pixel = Composite(fragments.data(), fragments.size());
    const std::vector<long double> all = BackToFront(fragments);
    fragments.resize(CountSeen(fragments));
    const std::vector<long double> expected = BackToFront(fragments);
    for (std::size_t k = 0; k < 4; ++k)
    {
      const auto channel = static_cast<double>(pixel.Rgba[k]);
      EXPECT_NEAR(channel, static_cast<double>(255.0L * expected[k]), 0.5 + 1e-9);
      EXPECT_NEAR(channel, static_cast<double>(255.0L * all[k]), 0.75);
    }
    EXPECT_EQ(pixel.Depth, PixelWithoutDepth);
  }
}

//------------------------------------------------------------------------------
TEST(Compositor, EndsAtTheFirstOpaqueFragmentAndTakesItsDepth)
{
  RandomNumbers random(4712);
  for (int run = 0; run < 2000; ++run)
  {
    std::vector<Fragment> fragments = { RandomFragment(random, 0.5), RandomFragment(random, 1.0) };
    const CompositedPixel pixel = Composite(fragments.data(), fragments.size());
    EXPECT_EQ(pixel.Rgba[3], 255);
    EXPECT_EQ(pixel.Depth, fragments[1].Depth);
    fragments.push_back(RandomFragment(random, 1.0));
    const CompositedPixel behind = Composite(fragments.data(), fragments.size());
    EXPECT_TRUE(std::equal(pixel.Rgba, pixel.Rgba + 4, behind.Rgba));
    EXPECT_EQ(behind.Depth, pixel.Depth);
  }
}

//------------------------------------------------------------------------------
TEST(Compositor, MakesBlackOfWhatIsNoNumber)
{
  const double nan = std::nan("");
  const Fragment fragment = { 1.0, { nan, 0.5, nan }, 1.0, 0.25F };
  const CompositedPixel pixel = Composite(&fragment, 1);
  EXPECT_EQ(pixel.Rgba[0], 0);
  EXPECT_EQ(pixel.Rgba[1], 128);
  EXPECT_EQ(pixel.Rgba[2], 0);
  EXPECT_EQ(pixel.Rgba[3], 255);
}

//------------------------------------------------------------------------------
TEST(Compositor, MergesTheFragmentsOfFieldsByT)
{
  RandomNumbers random(4713);
  constexpr int rays = 50;
  const auto byT = [](const Fragment& a, const Fragment& b) { return a.T < b.T; };
  std::vector<Fragments> fields(3);
  std::vector<std::vector<double>> expected(rays);
  for (Fragments& field : fields)
  {
    field.Clear();
    for (int ray = 0; ray < rays; ++ray)
    {
      const auto first = static_cast<std::ptrdiff_t>(field.List.size());
      const int count = random.Integer(0, 4);
      for (int i = 0; i < count; ++i)
      {
        field.List.push_back(RandomFragment(random, 0.5));
        expected[static_cast<std::size_t>(ray)].push_back(field.List.back().T);
      }
      std::sort(field.List.begin() + first, field.List.end(), byT);
      field.First.push_back(field.List.size());
    }
  }
  Fragments merged;
  Merge(fields, merged);
  ASSERT_EQ(merged.First.size(), rays + 1U);
  for (std::size_t ray = 0; ray < rays; ++ray)
  {
    std::sort(expected[ray].begin(), expected[ray].end());
    std::vector<double> actual;
    for (std::size_t i = merged.First[ray]; i < merged.First[ray + 1]; ++i)
    {
      actual.push_back(merged.List[i].T);
    }
    EXPECT_EQ(actual, expected[ray]);
  }
}

//------------------------------------------------------------------------------
TEST(Compositor, PutsTheFirstFieldFirstAtEqualT)
{
  std::vector<Fragments> fields(2);
  for (std::size_t i = 0; i < 2; ++i)
  {
    fields[i].List = { { 3.0, {}, 0.25 * (1.0 + static_cast<double>(i)), 0.0F } };
    fields[i].First = { 0, 1 };
  }
  Fragments merged;
  Merge(fields, merged);
  ASSERT_EQ(merged.List.size(), 2U);
  EXPECT_EQ(merged.List[0].Opacity, 0.25);
  EXPECT_EQ(merged.List[1].Opacity, 0.5);
}

}
}
