// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCloudTextureAdvection
 * @brief Texture coordinates that move with the wind, so that a cloud texture drifts with its clouds.
 *
 * After Max and Crawfis 1992 (as told in Max 1994), semi-Lagrangian: the coordinates at a point are the place, in metres, where its
 * air was when the texture was started. For a requested time the filter
 *  1. asks its input for those file times that lie between the start of each texture and the requested time,
 *  2. carries the displacement of the coordinates over each interval (nephoscope::carriedCoordinates),
 *  3. asks for the requested time itself, whose other arrays pass through, and adds the coordinates.
 * The coordinates would be sheared without bound; so a texture lives two periods, its weight rising over the first and falling over
 * the second, and a new one starts every period: two are there at a time, displaced far from each other, so that their
 * patterns are independent. Whoever evaluates them blends with weights w, 1 - w about the mean and restores the contrast
 * (nephoscope::CloudTexture::blended), as vtkCloudTexture and vtkCloudSurface do.
 *
 * Input    vtkStructuredGrid with Wind (m/s, along the scene's axes), Height (m) and the field data Geometry, PlanetRadius, HeightScale
 *          as vtkCloudNetCDFReader gives them; time keys in seconds.
 * Output   the input at the requested time, and point arrays (float)
 *            TextureCoordinates       3, m: on a Globe and a Map Cartesian about the planet's centre, else x, y, z
 *            OtherTextureCoordinates  3, m: the second texture's (with CrossFade)
 *            TextureStretch           1, largest singular value of the heavier texture's coordinate map along the levels
 *          field data TextureWeights (2 double). TIME_STEPS and TIME_RANGE are the input's; any time in the range can be asked for.
 * Parameters: see the setters.
 * Method   trajectories: Trajectory.h; vertical motion through terrain-following or moving levels: motionThroughLevels.
 *          A texture's state at a file time depends on its start and the file alone, so the same time gives the same bits,
 *          whatever was asked for before.
 * Errors   an input that fails, no Wind or Height, a grid whose lines do not run along meridians and parallels (or x and y), times
 *          that do not rise, a time outside the range: vtkErrorMacro, return 0. Where several processes advect together, what is wrong
 *          in one ends the update of all. Without time steps the coordinates are the places.
 * Cost     per interval one trajectory a point, shared by textures that do not start in it: 8 (linear) or 64 (cubic) weighted reads a
 *          stage and substep; rows of levels have as many substeps as their wind needs (nephoscope::substepsOfRows). On
 *          320 x 160 x 19 points, Runge-Kutta 2, linear, one substep: 0.4 s of one core, half of it for locating positions in
 *          the grid and reading the wind there. Spread over threads, the same bits for any number. Memory: wind and height
 *          at two times, 12 bytes a point and texture.
 * Pieces   together, where each process of the Controller asks for its own of as many pieces (UpdatePiece(rank, ranks)): each
 *          reads its block and follows the air of its own columns alone. For every interval it gets, from the processes that have
 *          them, wind, heights, motion through the levels and displacements of the columns about its block, as far as the strongest wind
 *          carries air in the interval. The strongest wind and strain of each row, the strain for RestartPeriod and the
 *          statistics of the stretch are those of the whole. Coordinates are the bits of one process. All processes have to update,
 *          with the same settings and times; an abort of one is one of all. An input that cannot even tell its times and extent in one
 *          process ends the update there, and the others wait. Other pieces, and inputs that do not give pieces:
 *          each asks for the whole extent and gives its block.
 * Limits   NaN winds are calm. Air that comes from beyond the edge of a regional grid has the edge's
 *          coordinates. An input that fails at a later time than the first ends the update in VTK's own pipelines; ParaView gives
 *          filters executives of its own, which do not call a filter then: the update goes on without end, and other processes wait.
 * @sa Trajectory.h, CoordinateMap.h, vtkCloudTexture, TestCloudTextureAdvection.cxx
 */
#ifndef vtkCloudTextureAdvection_h
#define vtkCloudTextureAdvection_h

#include "vtkCloudFiltersModule.h" // for export macro
#include "vtkSmartPointer.h"       // for the controller
#include "vtkStructuredGridAlgorithm.h"

#include <memory> // for members

class vtkMultiProcessController;
class vtkStructuredGrid;

class VTKCLOUDFILTERS_EXPORT vtkCloudTextureAdvection : public vtkStructuredGridAlgorithm
{
public:
  static vtkCloudTextureAdvection* New();
  vtkTypeMacro(vtkCloudTextureAdvection, vtkStructuredGridAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum IntegratorType
  {
    RungeKutta2 = 0,
    RungeKutta4
  };
  enum InterpolationType
  {
    Linear = 0,
    Cubic
  };

  ///@{
  /// Order of the trajectories. Default RungeKutta2.
  vtkSetClampMacro(Integrator, int, RungeKutta2, RungeKutta4);
  vtkGetMacro(Integrator, int);
  void SetIntegratorToRungeKutta2() { this->SetIntegrator(RungeKutta2); }
  void SetIntegratorToRungeKutta4() { this->SetIntegrator(RungeKutta4); }
  ///@}

  ///@{
  /// How wind and coordinates are read between the points. Default Linear.
  vtkSetClampMacro(Interpolation, int, Linear, Cubic);
  vtkGetMacro(Interpolation, int);
  void SetInterpolationToLinear() { this->SetInterpolation(Linear); }
  void SetInterpolationToCubic() { this->SetInterpolation(Cubic); }
  ///@}

  ///@{
  /// Error that a trajectory may have over an interval, m; sets the number of substeps. Default 5000, 0.001 to 1e7.
  vtkSetClampMacro(Tolerance, double, 1e-3, 1e7);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /// Whether textures are started again and cross-faded. Off: one texture, started at the first time. Default on.
  vtkSetMacro(CrossFade, bool);
  vtkGetMacro(CrossFade, bool);
  vtkBooleanMacro(CrossFade, bool);
  ///@}

  ///@{
  /// Seconds from one start to the next. 0, the default: ln 2 / (1.5 strain), with the strain rate that 95 % of the points do not
  /// exceed in the first time's wind, so that these are stretched less than about twofold until a texture has faded to half its
  /// weight; within an hour to ten days.
  vtkSetClampMacro(RestartPeriod, double, 0.0, 1e10);
  vtkGetMacro(RestartPeriod, double);
  ///@}

  ///@{
  /// Processes that advect together, each its piece. Default the global controller of VTK, which ParaView's servers have and a
  /// program of one process has not; null: each for itself.
  void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController() const;
  ///@}

  ///@{
  /// Of the last update: the period in use (s), median and largest TextureStretch, the most substeps of a row in the last interval.
  vtkGetMacro(UsedRestartPeriod, double);
  vtkGetMacro(MedianStretch, double);
  vtkGetMacro(MaximumStretch, double);
  vtkGetMacro(NumberOfSubsteps, int);
  ///@}

protected:
  vtkCloudTextureAdvection();
  ~vtkCloudTextureAdvection() override;

  /// How far away columns were fetched for an interval at most, in units of the strongest wind's reach: 1, 2, 4 ...; 1 if alone.
  double FarthestReach() const;

  vtkExecutive* CreateDefaultExecutive() override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkCloudTextureAdvection(const vtkCloudTextureAdvection&) = delete;
  void operator=(const vtkCloudTextureAdvection&) = delete;

  int Integrator = RungeKutta2;
  int Interpolation = Linear;
  double Tolerance = 5000;
  bool CrossFade = true;
  double RestartPeriod = 0;
  double UsedRestartPeriod = 0;
  double MedianStretch = 1;
  double MaximumStretch = 1;
  int NumberOfSubsteps = 1;

  bool IsTogether(vtkInformation* output) const;
  bool Begin(vtkInformation* input, bool together);
  int Ask(vtkInformation* input, vtkInformation* output, double target);
  void TakeTime(vtkInformation* request, vtkStructuredGrid* input);
  void AddCoordinates(vtkStructuredGrid* output);

  vtkSmartPointer<vtkMultiProcessController> Controller;
  struct Progress;
  std::unique_ptr<Progress> Work;
};
#endif
