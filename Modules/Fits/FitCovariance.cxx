// SPDX-License-Identifier: BSD-3-Clause
#include "FitCovariance.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace nephoscope
{
namespace
{
constexpr double Rank = 1e-7;      // least singular value of the largest that counts
constexpr double Involved = 0.1;   // share of a direction that names a parameter
constexpr double NearBound = 1e-9; // of the distance between the bounds

std::string list(const std::vector<std::string>& names)
{
  std::string text;
  for (const std::string& name : names)
  {
    text += (text.empty() ? "" : ", ") + name;
  }
  return text;
}

/// Marks parameters at a bound; returns the numbers of the others.
std::vector<int> freeParameters(Fit& fit)
{
  std::vector<int> free;
  for (std::size_t i = 0; i < fit.parameters.size(); ++i)
  {
    FittedParameter& p = fit.parameters[i];
    const double near = NearBound * (p.upper - p.lower);
    p.atBound = p.value - p.lower <= near || p.upper - p.value <= near;
    if (!p.atBound)
    {
      free.push_back(static_cast<int>(i));
      continue;
    }
    const bool low = p.value - p.lower <= near;
    char text[200];
    std::snprintf(text, sizeof text, "%s is at its %s bound %g", p.name.c_str(),
      low ? "lower" : "upper", low ? p.lower : p.upper);
    fit.warnings.emplace_back(text);
  }
  return free;
}

/// Columns of the free parameters, each of length 1 (0 stays 0), and their lengths.
Eigen::MatrixXd scaledColumns(const std::vector<double>& jacobian, int parameters,
  const std::vector<int>& free, Eigen::VectorXd& length)
{
  const int rows = static_cast<int>(jacobian.size()) / parameters;
  Eigen::MatrixXd columns(rows, free.size());
  length.resize(static_cast<int>(free.size()));
  for (std::size_t j = 0; j < free.size(); ++j)
  {
    for (int i = 0; i < rows; ++i)
    {
      columns(i, j) = jacobian[static_cast<std::size_t>(i) * parameters + free[j]];
    }
    length(j) = columns.col(j).norm();
    if (length(j) > 0)
    {
      columns.col(j) /= length(j);
    }
  }
  return columns;
}

/// What no direction of the cases reaches is not determined.
void markUndetermined(
  Fit& fit, const std::vector<int>& free, const Eigen::VectorXd& singular, const Eigen::MatrixXd& v)
{
  std::vector<std::string> names;
  for (std::size_t j = 0; j < free.size(); ++j)
  {
    bool open = false;
    for (int k = 0; k < singular.size(); ++k)
    {
      const bool reached = singular(k) > Rank * singular(0);
      open = open || (!reached && std::abs(v(j, k)) > Involved);
    }
    if (open)
    {
      FittedParameter& p = fit.parameters[free[j]];
      p.determined = false;
      p.standardError = (p.upper - p.lower) / std::sqrt(12.0);
      names.push_back(p.name);
    }
  }
  if (!names.empty())
  {
    fit.warnings.push_back("the cases do not determine " + list(names) +
      ": another value fits as well; fix it or add cases that depend on it");
  }
}
}

void setCovariance(Fit& fit, const std::vector<double>& jacobian, double squares)
{
  const int n = static_cast<int>(fit.parameters.size());
  fit.covariance.assign(static_cast<std::size_t>(n) * n, 0.0);
  const std::vector<int> free = freeParameters(fit);
  if (free.empty())
  {
    return;
  }
  Eigen::VectorXd length;
  const Eigen::MatrixXd columns = scaledColumns(jacobian, n, free, length);
  const Eigen::JacobiSVD<Eigen::MatrixXd, Eigen::ColPivHouseholderQRPreconditioner> svd(
    columns, Eigen::ComputeThinV);
  const Eigen::VectorXd& singular = svd.singularValues();
  const Eigen::MatrixXd& v = svd.matrixV();
  markUndetermined(fit, free, singular, v);
  const double variance = squares / std::max<double>(1, columns.rows() - n);
  for (std::size_t i = 0; i < free.size(); ++i)
  {
    for (std::size_t j = 0; j < free.size(); ++j)
    {
      const bool known = fit.parameters[free[i]].determined && fit.parameters[free[j]].determined;
      double sum = 0;
      for (int k = 0; known && k < singular.size() && singular(k) > Rank * singular(0); ++k)
      {
        sum += v(i, k) * v(j, k) / (singular(k) * singular(k));
      }
      const double scale = length(i) * length(j);
      fit.covariance[static_cast<std::size_t>(free[i]) * n + free[j]] =
        known && scale > 0 ? variance * sum / scale : 0;
    }
    FittedParameter& p = fit.parameters[free[i]];
    const double own = fit.covariance[static_cast<std::size_t>(free[i]) * (n + 1)];
    p.standardError = p.determined ? std::sqrt(own) : p.standardError;
  }
}
}
