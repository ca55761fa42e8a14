// SPDX-License-Identifier: BSD-3-Clause
#include "LineDiffusion.h"

#include <cmath>
#include <limits>

namespace nephoscope
{
DiffusionLine::DiffusionLine(int size)
  : value(size)
  , capacity(size)
  , conductance(size)
  , Diagonal(size)
  , Off(size)
  , Reduced(size)
  , Correction(size)
  , Missing(size)
{
}

void DiffusionLine::solve(std::vector<double>& unknown)
{
  const int n = this->size();
  double pivot = this->Diagonal[0];
  unknown[0] /= pivot;
  for (int i = 1; i < n; ++i)
  {
    this->Reduced[i] = this->Off[i - 1] / pivot;
    pivot = this->Diagonal[i] - this->Off[i - 1] * this->Reduced[i];
    unknown[i] = (unknown[i] - this->Off[i - 1] * unknown[i - 1]) / pivot;
  }
  for (int i = n - 2; i >= 0; --i)
  {
    unknown[i] -= this->Reduced[i + 1] * unknown[i + 1];
  }
}

void DiffusionLine::setSystem(double step, bool ring)
{
  const int n = this->size();
  for (int i = 0; i < n; ++i)
  {
    this->Missing[i] = std::isnan(this->value[i]) ? 1 : 0;
  }
  for (int i = 0; i < n; ++i)
  {
    const int next = i + 1 < n ? i + 1 : 0;
    const bool joined = (i + 1 < n || ring) && !this->Missing[i] && !this->Missing[next];
    this->Off[i] = joined ? -step * this->conductance[i] : 0;
  }
  for (int i = 0; i < n; ++i)
  {
    const double before = i > 0 ? this->Off[i - 1] : this->Off[n - 1];
    this->Diagonal[i] = this->capacity[i] - before - this->Off[i];
    this->value[i] = this->Missing[i] ? 0 : this->value[i] * this->capacity[i];
  }
}

void DiffusionLine::diffuse(double step, bool ring)
{
  const int n = this->size();
  if (n < 2)
  {
    return;
  }
  this->setSystem(step, ring);
  const double closing = this->Off[n - 1];
  if (closing == 0)
  {
    this->solve(this->value);
  }
  else
  {
    // The ring's matrix is a line's plus closing (e_0 + e_n)(e_0 + e_n)^T; both ends of that line give it up.
    this->Diagonal[0] -= closing;
    this->Diagonal[n - 1] -= closing;
    std::vector<double>& f = this->value;
    std::vector<double>& z = this->Correction;
    z.assign(n, 0);
    z[0] = 1;
    z[n - 1] = 1;
    this->solve(z);
    this->solve(f);
    const double factor = closing * (f[0] + f[n - 1]) / (1 + closing * (z[0] + z[n - 1]));
    for (int i = 0; i < n; ++i)
    {
      f[i] -= factor * z[i];
    }
  }
  for (int i = 0; i < n; ++i)
  {
    if (this->Missing[i])
    {
      this->value[i] = std::numeric_limits<double>::quiet_NaN();
    }
  }
}
}
