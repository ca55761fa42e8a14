// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCloudVDBReader
 * @brief Reads a fog volume of an OpenVDB file: as an image, or as the bricks that a vtkCloudVoxelVolume draws.
 *
 * Passes: 1. the file's header is checked against its size; 2. the bytes of the wanted grid are read, never past them; 3. its active voxels
 * become bricks of 8 x 8 x 8, tiles included; 4. the bricks are given as they are, or laid into an image.
 *
 * Input    a .vdb file with file version 222 to 224 (OpenVDB since 2013), grids of float, double or vec3s; level sets become fog
 *          with a warning: 1 inside, falling to 0 in the band about the surface.
 * Output   Bricks: vtkPolyData, a vertex a brick, with the arrays VoxelBricks, VoxelOrigins and the field data VoxelToScene of
 *            CloudArrays.h; of a vec3s grid VoxelBricks has 1536 components, those of a voxel together.
 *          Image: vtkImageData over the bounding box of the bricks' voxels that are not 0; a point a voxel, float array of the grid's name.
 *          Both: the metadata of file and grid as field data, texts as strings, numbers as doubles, under their names; GridName, a
 *            string. What OpenVDB keeps for itself (class, is_*, file_*, ...) is left out.
 * Parameters: see the setters.
 * Pieces   of an image: blocks of it. Bricks: each piece is the whole, as sunlight comes to a brick through all others.
 * Errors   a file that is missing, cut short or damaged, no grid of the name or of a readable type, a frustum transform, more than
 *          MaximumVoxels, for an image a transform with shear: one line with file, grid and remedy, an empty output.
 * Cost     memory: some 40 times the grid's bytes at most while the tree is read; then 2 kB a brick; an image 4 bytes a point.
 * Limits   voxels inside the tree of a damaged file that still make sense are given as they are: the format has no checksums.
 * @sa vtkCloudVDBWriter, vtkCloudVoxelVolume, TestCloudVDB
 */
#ifndef vtkCloudVDBReader_h
#define vtkCloudVDBReader_h

#include "vtkCloudSparseModule.h" // for export macro
#include "vtkDataObjectAlgorithm.h"

#include <memory> // for members
#include <string> // for members

namespace nephoscope
{
struct VoxelGrid;
}
class vtkImageData;

class VTKCLOUDSPARSE_EXPORT vtkCloudVDBReader : public vtkDataObjectAlgorithm
{
public:
  static vtkCloudVDBReader* New();
  vtkTypeMacro(vtkCloudVDBReader, vtkDataObjectAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// The file. Required.
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /// The grid to read. Default empty: density, else the first that can be read.
  vtkSetMacro(GridName, std::string);
  vtkGetMacro(GridName, std::string);
  ///@}

  enum OutputFormType
  {
    Bricks = 0,
    Image
  };

  ///@{
  /// What to make of it. Default Bricks.
  vtkSetClampMacro(OutputForm, int, Bricks, Image);
  vtkGetMacro(OutputForm, int);
  void SetOutputFormToBricks() { this->SetOutputForm(Bricks); }
  void SetOutputFormToImage() { this->SetOutputForm(Image); }
  ///@}

  ///@{
  /// Most voxels, of the bricks or of the image. Default 2e8.
  vtkSetClampMacro(MaximumVoxels, double, 512, 1e12);
  vtkGetMacro(MaximumVoxels, double);
  ///@}

protected:
  vtkCloudVDBReader();
  ~vtkCloudVDBReader() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override;
  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override;

private:
  vtkCloudVDBReader(const vtkCloudVDBReader&) = delete;
  void operator=(const vtkCloudVDBReader&) = delete;

  bool Load();
  bool FindExtent(int extent[6]);
  bool FillImage(const nephoscope::VoxelGrid& grid, const int extent[6], vtkImageData* image);

  std::shared_ptr<nephoscope::VoxelGrid> Loaded; ///< from RequestInformation to RequestData

  char* FileName = nullptr;
  std::string GridName;
  int OutputForm = Bricks;
  double MaximumVoxels = 2e8;
};
#endif
