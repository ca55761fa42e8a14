// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCloudVDBWriter
 * @brief Writes clouds as sparse fog volumes: an OpenVDB file for Blender, Houdini and other renderers.
 *
 * Passes, for a curvilinear grid:
 *  1. the cells that have cloud are sorted into bricks of 8 x 8 x 8 voxels;
 *  2. each brick's voxels get the mean of the field over them, in parallel (nephoscope::BrickSampler);
 *  3. voxels up to PruningTolerance are dropped, and one factor a grid makes its total that of the cells;
 *  4. bricks of one value become tiles; grids are compressed side by side, and the file is written beside its place and renamed.
 * The points of a vtkImageData are written as voxels, one each, without passes 1 to 3.
 *
 * Input    port 0, vtkStructuredGrid with the point arrays that vtkCloudNetCDFReader gives, or vtkImageData with any.
 * Output   the file, with the grids, if their arrays are there,
 *            density  float, extinction per scene unit: that is 1/m unless HeightScale says that heights are exaggerated
 *            liquid   float, kg/m3, LiquidWater times the air's density
 *            ice      float, kg/m3
 *            wind     vec3s, m/s, along the scene's axes, the mean over the part of each voxel that is in cells with cloud
 *          An image's arrays Extinction, LiquidWater, IceWater and Wind are called so too, others keep their names.
 *          Metadata of a grid: units, mass (the sum of the values times the voxel's volume, of the cells), mass_factor,
 *          pruning_tolerance, interpolation; of the file: creator, Source, Time, and the input's field data Geometry, PlanetRadius,
 *          HeightScale, Projection.
 * Parameters: see the setters.
 * Method   the field is linear in the five tetrahedra of each cell (TetrahedralSplit.h). density is Extinction if there is one;
 *          else that of condensate (Optics.h, Q = 2); else FullCoverExtinction times CloudFraction. Samples in a voxel, 2 to 16 along each
 *          axis, lie no farther apart than half the thickness that all but a tenth of the cells have.
 * Errors   no clouds' arrays, a voxel size that is not positive or makes more than MaximumVoxels, a file that cannot be written:
 *          vtkErrorMacro, nothing is left behind; GetErrorCode is not 0 if the file could not be written.
 * Cost     320 x 160 x 19 points to 1/4 degree: see Utilities/Doc/sparse.md. The same bits for any number of threads.
 * Limits   mass is conserved in total, not in each cell: mass_factor says how far the samples were off. Cells with a missing value
 *          (NaN) are empty. With Half, values below 6e-8 vanish.
 * @sa vtkCloudVDBReader, nephoscope::BrickSampler, TestCloudVDB
 */
#ifndef vtkCloudVDBWriter_h
#define vtkCloudVDBWriter_h

#include "vtkAlgorithm.h"
#include "vtkCloudSparseModule.h" // for export macro

#include <string> // for members
#include <vector> // for members

namespace nephoscope
{
class FogGrid;
}

class VTKCLOUDSPARSE_EXPORT vtkCloudVDBWriter : public vtkAlgorithm
{
public:
  static vtkCloudVDBWriter* New();
  vtkTypeMacro(vtkCloudVDBWriter, vtkAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// The data of port 0 as given, or of a pipeline by SetInputConnection.
  void SetInputData(vtkDataObject* data);

  /// Bring the input up to date and write it. Returns 1, or 0 after an error.
  int Write();

  ///@{
  /// The file to write. Required.
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /// Edges of a voxel, scene units, > 0. Default 0: cubes, 1/400 of the grid's longest side. Programs such as vdb_render want cubes.
  /// An image has its own.
  vtkSetVector3Macro(VoxelSize, double);
  vtkGetVector3Macro(VoxelSize, double);
  ///@}

  ///@{
  /// The grids to write, by their names in the file. Default none: all that can be made.
  void AddGridName(const std::string& name);
  void ClearGridNames();
  ///@}

  ///@{
  /// Whether to write 16-bit floats: 3 digits, half the size. Default off.
  vtkSetMacro(Half, bool);
  vtkGetMacro(Half, bool);
  vtkBooleanMacro(Half, bool);
  ///@}

  ///@{
  /// Share of the largest value of a grid up to which a voxel counts as empty, and by which values of a tile may differ; 0 to 1. Default
  /// 1e-5.
  vtkSetClampMacro(PruningTolerance, double, 0, 1);
  vtkGetMacro(PruningTolerance, double);
  ///@}

  ///@{
  /// Most voxels, counted in whole bricks. Default 2e8.
  vtkSetClampMacro(MaximumVoxels, double, 512, 1e12);
  vtkGetMacro(MaximumVoxels, double);
  ///@}

  ///@{
  /// Effective radii of droplets and crystals, m, > 0, defaults 10e-6 and 30e-6; extinction of full cover, 1/m, default 0.15e-3.
  vtkSetClampMacro(LiquidRadius, double, 1e-9, 1);
  vtkGetMacro(LiquidRadius, double);
  vtkSetClampMacro(IceRadius, double, 1e-9, 1);
  vtkGetMacro(IceRadius, double);
  vtkSetClampMacro(FullCoverExtinction, double, 0, 1e9);
  vtkGetMacro(FullCoverExtinction, double);
  ///@}

  ///@{
  /// Metadata of the file: where the data come from, and their time. Default empty: none.
  vtkSetMacro(Source, std::string);
  vtkGetMacro(Source, std::string);
  vtkSetMacro(Time, std::string);
  vtkGetMacro(Time, std::string);
  ///@}

  ///@{
  /// Of the last file: grids, and of one of them its voxels that are not 0, its mass and the factor that made it so.
  int GetNumberOfGrids() const;
  std::string GetGridName(int grid) const;
  vtkIdType GetNumberOfVoxels(int grid) const;
  double GetMass(int grid) const;
  double GetMassFactor(int grid) const;
  ///@}

protected:
  vtkCloudVDBWriter();
  ~vtkCloudVDBWriter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkCloudVDBWriter(const vtkCloudVDBWriter&) = delete;
  void operator=(const vtkCloudVDBWriter&) = delete;

  std::vector<nephoscope::FogGrid> MakeGrids(vtkDataObject* data);
  void WriteData(vtkDataObject* data);

  char* FileName = nullptr;
  double VoxelSize[3] = { 0, 0, 0 };
  std::vector<std::string> GridNames;
  bool Half = false;
  double PruningTolerance = 1e-5;
  double MaximumVoxels = 2e8;
  double LiquidRadius = 10e-6;
  double IceRadius = 30e-6;
  double FullCoverExtinction = 0.15e-3;
  std::string Source;
  std::string Time;
  bool Written = false;

  struct Figures
  {
    std::string Name;
    vtkIdType Voxels;
    double Mass;
    double Factor;
  };
  std::vector<Figures> Grids;
};
#endif
