// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCloudVoxelVolume
 * @brief A sparse voxel cloud in sunlight that is scattered once, drawn from its bricks without a dense copy.
 *
 * Passes:
 *  1. Prepare makes a nephoscope::VoxelTree of the bricks when these have changed;
 *  2. when they, or the sun, have, the sun's depth is swept through the bricks wave by wave, those of a wave in parallel;
 *  3. Emit walks each pixel's ray through the bricks that it meets and adds a segment for each few of them.
 *
 * Input    port 0: vtkPolyData with the point arrays VoxelBricks (512 components), VoxelOrigins and the field data VoxelToScene of
 *          CloudArrays.h, as vtkCloudVDBReader gives it. The density is trilinear between voxels' centres, 0 outside the bricks.
 * Parameters: see the setters.
 * Method   sigma = ExtinctionScale density. A stretch's
 *            radiance = Albedo (SunColor (1 - a) 4 pi p(angle) J + SkyColor a (1 - T)),   a = Ambient
 *          with J the light scattered once (VoxelTree.h), p the phase function of Henyey and Greenstein 1941 for the angle of
 *          propagation, T what it lets through. The second term, as in vtkCloudHeightField, stands for light scattered often and
 *          from the sky. Optical depths are exact for the trilinear density; a ray ends where less than 1e-4 gets through.
 * Errors   no such arrays, bricks that lie too far apart, a singular matrix: vtkErrorMacro, nothing is drawn.
 * Cost     some 10 ns for each cell that a ray meets; the sweep 10 us a brick. 5.8 kB a brick. The same bits for any number of threads.
 * Limits   light scattered more than once is not followed. Neighbouring translucent bodies mix within segments of optical depth 1/4 as
 *          uniform media do.
 * @sa vtkCloudVDBReader, nephoscope::VoxelTree
 */
#ifndef vtkCloudVoxelVolume_h
#define vtkCloudVoxelVolume_h

#include "vtkCloudLitBody.h"
#include "vtkCloudRenderingModule.h" // for export macro

#include <memory> // for members

class VTKCLOUDRENDERING_EXPORT vtkCloudVoxelVolume : public vtkCloudLitBody
{
public:
  static vtkCloudVoxelVolume* New();
  vtkTypeMacro(vtkCloudVoxelVolume, vtkCloudLitBody);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Extinction per scene unit of a density of 1, >= 0. Default 1, for files whose density is an extinction.
  vtkSetClampMacro(ExtinctionScale, double, 0, 1e9);
  vtkGetMacro(ExtinctionScale, double);
  ///@}
  ///@{
  /// Share of the extinction that is scattered, 0 to 1. Default 1.
  vtkSetClampMacro(Albedo, double, 0, 1);
  vtkGetMacro(Albedo, double);
  ///@}
  ///@{
  /// Mean cosine of the scattering angle, -0.95 to 0.95: 0 scatters evenly. Default 0.
  vtkSetClampMacro(Asymmetry, double, -0.95, 0.95);
  vtkGetMacro(Asymmetry, double);
  ///@}

  /// Bricks of cells that the last Prepare found.
  vtkIdType GetNumberOfDrawnCells() const override;

#ifndef __VTK_WRAP__
  bool Prepare(const nephoscope::Camera& camera) override;
  void Emit(const nephoscope::Camera& camera, nephoscope::DeepTile& tile) const override;
#endif

protected:
  vtkCloudVoxelVolume();
  ~vtkCloudVoxelVolume() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;

  double ExtinctionScale = 1;
  double Albedo = 1;
  double Asymmetry = 0;

private:
  vtkCloudVoxelVolume(const vtkCloudVoxelVolume&) = delete;
  void operator=(const vtkCloudVoxelVolume&) = delete;

  struct Internals;
  bool ReadBricks();
  void SweepSun();

  std::unique_ptr<Internals> Data;
};
#endif
