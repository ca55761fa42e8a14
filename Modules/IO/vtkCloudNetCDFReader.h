// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCloudNetCDFReader
 * @brief Reads the gridded cloudiness of a climate or weather model from NetCDF: a vtkStructuredGrid in the scene.
 *
 * The points of the grid are the centres of the file's boxes, so that its cells are the dual grid that Max 1994 contours.
 * The passes:
 *  1. each role (cloud fraction, water, wind, pressure, ...) finds its variable: an explicit choice, else the standard_name, else
 *     the names that CF, CMIP, CAM/E3SM, ECMWF, WRF and the Met Office use;
 *  2. the first of cloud fraction, liquid, ice that is there (else the first explicit choice) gives dimensions and axes;
 *  3. the vertical coordinate becomes pressure and height; what the file holds wins over what is derived;
 *  4. the horizontal grid is laid into the scene and the winds are turned with it.
 *
 * Input    a NetCDF file (classic, 64-bit or netCDF-4), regular or Gaussian longitude-latitude, projected, rotated, curvilinear
 *          (2-D longitudes and latitudes), a plane in metres, or a curtain of columns.
 * Output   vtkStructuredGrid; i runs east (or along x), j north (or along y), k up, whatever the file's order. Points double.
 *          Point arrays, float, each if it is in the file or can be derived, named in CloudArrays.h:
 *            CloudFraction 0..1; LiquidWater, IceWater, SpecificHumidity kg/kg; Wind m/s, along the scene's axes;
 *            Pressure Pa; Height m (always there, never exaggerated); Temperature K.
 *          A value that the file masks is NaN and its point is hidden (vtkGhostType) if it is the cloudiness that is missing.
 *          Field data: Geometry, PlanetRadius, HeightScale, Projection; Derived (string per derived quantity).
 *          Globe: a grid that goes round gets its first column again at the end, and a row at each pole that is not on the grid,
 *          with the mean of the last row, so that the globe is closed. Map: the column only.
 *          Time: TIME_STEPS in seconds since the reference instant of the file's time unit, in the file's own calendar. The step
 *          nearest to the requested time is read; a request outside the file's range is an error.
 * Pieces   blocks of whole columns (nephoscope::columnBlock), read with as many levels of ghosts round about as are asked for along i
 *          and j: from the file, on a Globe across the seam as well, where the extent then goes on beyond the whole one. Ghosts are
 *          marked in vtkGhostType (duplicate points and cells). More pieces than columns: the last ones are empty. A piece at a pole
 *          or across the seam reads its rows' whole width.
 * Parameters: see the setters.
 * Method   vertical: VerticalCoordinate.h. Height is geopotential / 9.80665 where the file has geopotential.
 *          Specific contents and mixing ratios are both taken as kg/kg without conversion (they differ by the humidity, < 3 %).
 * Errors   a file that is missing, cut short or not NetCDF, no cloud variable, an unknown vertical coordinate, wrong units, a
 *          non-monotonic axis, only missing values, one level, one column, a time out of range, unstructured columns:
 *          one line with file, variable and remedy, return 0. Every guess is a line of GetWarning.
 * Cost     one time step of the requested extent (with whole columns) in memory; the file is read by one thread (netCDF-C is
 *          not thread-safe), the rest is spread over threads and does not depend on their number.
 * Limits   groups of netCDF-4 other than the root are not read. Reduced and unstructured grids are refused. A seam is closed only
 *          where longitude is an axis. A netCDF-4 file with damaged inner tables can crash HDF5 itself (about one in a
 *          thousand of TestNetCDFReaderMutations); classic headers are checked before netCDF-C sees them.
 * @sa VerticalCoordinate.h, CloudArrays.h, TestNetCDFReader
 */
#ifndef vtkCloudNetCDFReader_h
#define vtkCloudNetCDFReader_h

#include "vtkCloudIOModule.h" // for export macro
#include "vtkStructuredGridAlgorithm.h"

#include <memory> // for members

class VTKCLOUDIO_EXPORT vtkCloudNetCDFReader : public vtkStructuredGridAlgorithm
{
public:
  static vtkCloudNetCDFReader* New();
  vtkTypeMacro(vtkCloudNetCDFReader, vtkStructuredGridAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// The file. Required.
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  enum GeometryType
  {
    Automatic = 0,
    Map,
    Globe,
    Local
  };

  ///@{
  /// How the grid lies in the scene. Default Automatic: Globe for a global grid; Local for a projected, rotated, curvilinear or
  /// metric grid; else Map.
  ///   Map    plate carree: x east, y north, z up, in metres on the equator or in degrees
  ///   Globe  centre at the origin, z to the north pole, x to longitude 0; distance PlanetRadius + exaggeration * height, m
  ///   Local  the file's own projection (else a stereographic one about the middle of the grid), m
  vtkSetClampMacro(Geometry, int, Automatic, Local);
  vtkGetMacro(Geometry, int);
  void SetGeometryToAutomatic() { this->SetGeometry(Automatic); }
  void SetGeometryToMap() { this->SetGeometry(Map); }
  void SetGeometryToGlobe() { this->SetGeometry(Globe); }
  void SetGeometryToLocal() { this->SetGeometry(Local); }
  ///@}

  enum MapUnitsType
  {
    Metres = 0,
    Degrees
  };

  ///@{
  /// Unit of a Map, heights included. Default Metres.
  vtkSetClampMacro(MapUnits, int, Metres, Degrees);
  vtkGetMacro(MapUnits, int);
  ///@}

  ///@{
  /// Factor on heights in the scene; the array Height stays in metres. Default 1, > 0.
  vtkSetClampMacro(VerticalExaggeration, double, 1e-6, 1e6);
  vtkGetMacro(VerticalExaggeration, double);
  ///@}

  ///@{
  /// Diagnose a cloud fraction by Xu and Randall 1996 where the file has condensate, temperature and humidity but no cloud
  /// fraction. Default off: the output then has no CloudFraction.
  vtkSetMacro(DiagnoseCloudFraction, bool);
  vtkGetMacro(DiagnoseCloudFraction, bool);
  vtkBooleanMacro(DiagnoseCloudFraction, bool);
  ///@}

  ///@{
  /// The variable of a role, for a file whose names are not known here or where another one is wanted. An empty name means that
  /// the role is not to be read. Roles: GetKnownRole. A role that is not known is an error of the next update.
  void SetVariableName(const char* role, const char* name);
  const char* GetVariableName(const char* role); ///< nullptr if there is no explicit choice
  void ClearVariableNames();
  static int GetNumberOfKnownRoles();
  static const char* GetKnownRole(int index);
  ///@}

  ///@{
  /// Which point arrays the output keeps, of those that UpdateInformation() found: all by default. Height is always kept. What is not
  /// kept is read all the same where others are worked out from it.
  int GetNumberOfPointArrays();
  const char* GetPointArrayName(int index);
  int GetPointArrayStatus(const char* name);
  void SetPointArrayStatus(const char* name, int keep);
  ///@}

  /// 1 if the file is NetCDF and has a cloud variable by one of the known names.
  static int CanReadFile(const char* name);

  ///@{
  /// What UpdateInformation() learned, without reading fields.
  int* GetFileDimensions() VTK_SIZEHINT(3); ///< boxes east, north, up in the file
  int* GetDimensions() VTK_SIZEHINT(3);     ///< points of the output: with seam and poles
  int GetNumberOfTimeSteps();
  double GetTimeValue(int step);      ///< seconds since the reference instant
  const char* GetTimeLabel(int step); ///< yyyy-mm-ddThh:mm:ss in the file's calendar
  const char* GetTimeUnits();         ///< of GetTimeValue: "seconds since ..."; empty without time
  const char* GetCalendar();
  /// GetTimeValue's scale at a date yyyy-mm-dd[Thh[:mm[:ss]]] in the file's calendar; NaN if it is none, or the file has no dates.
  double GetTimeOfDate(const char* date);
  const char* GetVerticalCoordinate(); ///< e.g. "hybrid sigma-pressure"
  int GetChosenGeometry();             ///< never Automatic
  const char* GetChosenGeometryAsString();
  int GetNumberOfRoles(); ///< roles that have a variable
  const char* GetRoleName(int index);
  const char* GetVariableOfRole(int index);
  const char* GetVariableOfRole(const char* role); ///< nullptr if it has none
  int GetNumberOfDerivations();
  const char* GetDerivation(
    int index); ///< "Height: hypsometric, from Temperature and SpecificHumidity"
  int GetNumberOfWarnings();
  const char* GetWarning(int index);
  ///@}

protected:
  vtkCloudNetCDFReader();
  ~vtkCloudNetCDFReader() override;

  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkCloudNetCDFReader(const vtkCloudNetCDFReader&) = delete;
  void operator=(const vtkCloudNetCDFReader&) = delete;

  char* FileName;
  int Geometry;
  int MapUnits;
  double VerticalExaggeration;
  bool DiagnoseCloudFraction;

  struct Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
