// SPDX-License-Identifier: BSD-3-Clause
#include "TetrahedronSum.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

// A function that is compiled anew, for its caller's processor, wherever it is called.
#define NEPHOSCOPE_IN_CALLER __attribute__((always_inline)) inline

namespace nephoscope
{
namespace
{
/// The numbers of 2 or 4 rays.
struct Two
{
  using Lanes = double __attribute__((vector_size(16)));
  using Counts = std::int64_t __attribute__((vector_size(16)));
  static constexpr int Number = 2;
};
struct Four
{
  using Lanes = double __attribute__((vector_size(32)));
  using Counts = std::int64_t __attribute__((vector_size(32)));
  static constexpr int Number = 4;
};

/// What is the same for a row's rays.
struct RowOfTetrahedron
{
  double slope[4]; ///< of the planes' keys along u
  double at[4];    ///< the same at u = 0
  double nearKey;
  double farKey;
  double varyingSlope;
  double varyingAt;
};

template <class Group, bool Parallel, int Enters>
NEPHOSCOPE_IN_CALLER void addRow(const RowOfTetrahedron& t, const RayField& field,
  const RayRow& rays, int width, double* sum, typename Group::Counts& met)
{
  using Lanes = typename Group::Lanes;
  constexpr Lanes Zero{};
  for (int i = 0; i < width; i += Group::Number)
  {
    Lanes u;
    Lanes stretch;
    Lanes leave;
    Lanes total;
    std::memcpy(&u, rays.u + i, sizeof u);
    std::memcpy(&stretch, rays.stretch + i, sizeof stretch);
    std::memcpy(&leave, rays.limitKey + i, sizeof leave);
    std::memcpy(&total, sum + i, sizeof total);
    Lanes enter = t.nearKey + Zero;
    leave = leave < t.farKey ? leave : t.farKey + Zero;
    for (int f = 0; f < 4; ++f)
    {
      const Lanes key = t.slope[f] * u + t.at[f];
      if (f < Enters)
      {
        enter = key > enter ? key : enter;
      }
      else
      {
        leave = key < leave ? key : leave;
      }
    }
    const auto inside = enter < leave;
    Lanes length = leave - enter;
    Lanes ends = enter + leave;
    if (!Parallel)
    {
      const Lanes inverse = 1 / (enter * leave);
      length *= inverse;
      ends *= -inverse;
    }
    const Lanes varying = t.varyingSlope * u + t.varyingAt;
    Lanes density =
      Parallel ? 2 * varying + field.fixed() * ends : 2 * field.fixed() + varying * ends;
    density = density > 2 * field.least() ? density : 2 * field.least() + Zero;
    density = density < 2 * field.greatest() ? density : 2 * field.greatest() + Zero;
    total += inside ? 0.5 * stretch * length * density : Zero;
    met -= inside;
    std::memcpy(sum + i, &total, sizeof total);
  }
}

template <class Group, bool Parallel, int Enters>
NEPHOSCOPE_IN_CALLER std::size_t addRows(
  const TetrahedronRays& tetrahedron, RayRow rays, const SumRows& rows)
{
  RowOfTetrahedron t;
  const RayField& field = tetrahedron.field();
  // From a trillionth of the depth on, so that the keys' product stays finite.
  const double near = std::max(tetrahedron.nearest(), 1e-12 * tetrahedron.farthest());
  t.nearKey = Parallel ? tetrahedron.nearest() : -1 / near;
  t.farKey = Parallel ? tetrahedron.farthest() : -1 / tetrahedron.farthest();
  t.varyingSlope = field.varying().a;
  for (int f = 0; f < 4; ++f)
  {
    t.slope[f] = tetrahedron.plane(f).a;
  }
  typename Group::Counts met{};
  double* sum = rows.opticalDepth;
  for (int y = 0; y < rows.height; ++y)
  {
    const double v = rows.v + y;
    for (int f = 0; f < 4; ++f)
    {
      t.at[f] = tetrahedron.plane(f).b * v + tetrahedron.plane(f).c;
    }
    t.varyingAt = field.varying().b * v + field.varying().c;
    addRow<Group, Parallel, Enters>(t, field, rays, rows.width, sum, met);
    sum += rows.rowLength;
    rays.stretch += rows.rowLength;
    rays.limitKey += rows.rowLength;
  }
  std::size_t all = 0;
  for (int n = 0; n < Group::Number; ++n)
  {
    all += static_cast<std::size_t>(met[n]);
  }
  return all;
}

template <class Group, bool Parallel>
NEPHOSCOPE_IN_CALLER std::size_t addEntered(
  const TetrahedronRays& tetrahedron, const RayRow& rays, const SumRows& rows)
{
  switch (tetrahedron.enters())
  {
    case 0:
      return addRows<Group, Parallel, 0>(tetrahedron, rays, rows);
    case 1:
      return addRows<Group, Parallel, 1>(tetrahedron, rays, rows);
    case 2:
      return addRows<Group, Parallel, 2>(tetrahedron, rays, rows);
    default:
      return addRows<Group, Parallel, 3>(tetrahedron, rays, rows);
  }
}

#if defined(__x86_64__)
__attribute__((target("avx2"))) std::size_t sumAVX2(
  const TetrahedronRays& tetrahedron, bool parallel, const RayRow& rays, const SumRows& rows)
{
  return parallel ? addEntered<Four, true>(tetrahedron, rays, rows)
                  : addEntered<Four, false>(tetrahedron, rays, rows);
}

bool haveAVX2()
{
  return __builtin_cpu_supports("avx2") != 0;
}
#else
constexpr auto sumAVX2 = sumOpticalDepthsPlainly;
constexpr bool haveAVX2()
{
  return false;
}
#endif
}

std::size_t sumOpticalDepthsPlainly(
  const TetrahedronRays& tetrahedron, bool parallel, const RayRow& rays, const SumRows& rows)
{
  return parallel ? addEntered<Two, true>(tetrahedron, rays, rows)
                  : addEntered<Two, false>(tetrahedron, rays, rows);
}

std::size_t sumOpticalDepths(
  const TetrahedronRays& tetrahedron, bool parallel, const RayRow& rays, const SumRows& rows)
{
  static const auto sum = haveAVX2() ? sumAVX2 : sumOpticalDepthsPlainly;
  return sum(tetrahedron, parallel, rays, rows);
}
}
