// SPDX-License-Identifier: BSD-3-Clause
#include "GaussLegendre.h"

#include <cmath>

namespace nephoscope
{
namespace
{
constexpr double Pi = 3.14159265358979323846;

struct Legendre
{
  double value;
  double slope;
};

/// P_n and its derivative by the recurrence of Abramowitz and Stegun 8.5.3, |x| < 1.
Legendre legendre(int n, double x)
{
  double before = 0;
  double p = 1;
  for (int k = 1; k <= n; ++k)
  {
    const double next = ((2 * k - 1) * x * p - (k - 1) * before) / k;
    before = p;
    p = next;
  }
  return { p, n * (x * p - before) / (x * x - 1) };
}
}

std::vector<QuadraturePoint> gaussLegendre(int n, double a, double b)
{
  std::vector<QuadraturePoint> points(n);
  const double middle = (a + b) / 2;
  const double half = (b - a) / 2;
  for (int i = 0; i < n; ++i)
  {
    double x = -std::cos(Pi * (i + 0.75) / (n + 0.5));
    Legendre p = legendre(n, x);
    for (int step = 0; step < 10 && std::abs(p.value) > 1e-16; ++step)
    {
      x -= p.value / p.slope;
      p = legendre(n, x);
    }
    points[i] = { middle + half * x, half * 2 / ((1 - x * x) * p.slope * p.slope) };
  }
  return points;
}

std::vector<QuadraturePoint> gaussLegendrePanels(int panels, int n, double a, double b)
{
  const std::vector<QuadraturePoint> unit = gaussLegendre(n, 0, 1);
  std::vector<QuadraturePoint> points;
  points.reserve(unit.size() * panels);
  const double width = (b - a) / panels;
  for (int panel = 0; panel < panels; ++panel)
  {
    for (const QuadraturePoint& point : unit)
    {
      points.push_back({ a + width * (panel + point.x), width * point.weight });
    }
  }
  return points;
}
}
