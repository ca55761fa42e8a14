// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file WindSource.h
 * @brief A made-up atmosphere at several times, in pieces as the reader gives them or whole: winds that turn, stretch, rise and change, on
 * levels that follow hills and move.
 */
#ifndef WindSource_h
#define WindSource_h

#include "vtkStructuredGridAlgorithm.h"

#include <string>
#include <vector>

class WindSource : public vtkStructuredGridAlgorithm
{
public:
  static WindSource* New();
  vtkTypeMacro(WindSource, vtkStructuredGridAlgorithm);

  std::string Geometry =
    "Map"; ///< a globe that is closed, if Globe; Map: in degrees; Local: 40 km apart
  int Columns = 48;
  int Rows = 25;
  int Levels = 4;
  double FirstLongitude = 0; ///< degrees, or km in a plane
  double Spacing = 7.5;
  double FirstLatitude = -84;
  double RowSpacing = 7;
  double Speed = 45;    ///< m/s
  double Roughness = 0; ///< m/s, of the other sign in each second pair of rows and levels
  std::vector<double> Times{ 0, 3600, 7200, 10800, 18000 };
  bool GivesPieces = true;
  double WithoutWindFrom = 1e30; ///< s
  double FailsFrom = 1e30;       ///< s
  vtkIdType LargestPiece = 0;    ///< points, of those that were made

protected:
  WindSource() { this->SetNumberOfInputPorts(0); }
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  WindSource(const WindSource&) = delete;
  void operator=(const WindSource&) = delete;

  bool FindExtent(vtkInformation* out, int extent[6]) const;
  void AddPoints(double time, vtkStructuredGrid* grid) const;
  void AddPoint(int i, int j, int k, double time, vtkStructuredGrid* grid) const;
};
#endif
