// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file LeftOutSteps.h
 * @brief Clouds carried along the wind against clouds that fade, judged by steps of a file that are left out.
 *
 * Of every two (or three) steps one is kept; those between are interpolated by vtkCloudTimeInterpolator, with and without
 * CarryClouds, and compared with what the file has.
 */
#ifndef LeftOutSteps_h
#define LeftOutSteps_h

#include <string>
#include <vector>

class vtkAlgorithm;

namespace nephoscope
{
namespace charts
{
/// Of one way to interpolate, over all points of all steps that were left out.
struct InterpolationScore
{
  double error = 0; ///< root mean square, in the quantity's unit
  double energy =
    0; ///< of the differences of neighbours along a level, over the true one; below 1 is blurred
  double pattern =
    0; ///< correlation of these differences with the true ones: 1 has each structure in its place
};

struct LeftOutSteps
{
  std::string name;     ///< of the file
  std::string quantity; ///< name of the point array
  int stride = 2;       ///< one of as many steps was kept
  double spread = 0;    ///< standard deviation of the true values
  InterpolationScore carried;
  InterpolationScore faded;
};

/**
 * @brief Leave out steps of what an algorithm puts out, a vtkStructuredGrid with time steps.
 * @param stride >= 2; it needs stride + 1 steps
 * Precondition: the quantity is a point array of every step. A step that cannot be made leaves what it adds out.
 * Throws std::runtime_error where there are too few steps, no such array or nothing in it that varies.
 * Cost: every step is read twice, those kept more often.
 */
LeftOutSteps leaveOut(
  vtkAlgorithm* source, const std::string& name, const std::string& quantity, int stride);

/// Chart of gradients' lack of correlation against error over spread, each a line from faded to carried: DIR/interpolation.svg, .png.
void writeInterpolationChart(const std::vector<LeftOutSteps>& compared, const std::string& folder);
}
}
#endif
