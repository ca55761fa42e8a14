// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCloudSurface
 * @brief A cloud as a smooth shaded, translucent surface of triangles.
 *
 * The counterpart of figures 5 and 6 of Max 1994: contour surfaces of cloudiness, opaque or with a transparency texture.
 *  1. The mesh is copied when it has changed.
 *  2. Prepare projects its points and sorts its triangles into bins of pixels.
 *  3. Emit finds the triangles that each pixel's ray meets (each ray through a shared edge meets just one of the two),
 *     shades the hit and adds it to the deep pixel.
 *
 * Input    port 0, vtkPolyData of triangles or convex polygons, counter-clockwise as seen from outside the cloud. Point
 *          arrays, each optional:
 *            normals             3, out of the cloud, any length; without them the triangles are flat
 *            TextureCoordinates  3, m, where the texture is looked up; without it the position itself
 *            OtherTextureCoordinates  3, m: with the field data TextureWeights (2), a second texture that the first is
 *                                cross-faded with (nephoscope::CloudTexture::blended)
 *            Opacity             1, 0..1, for OpacityFromArray
 * Parameters: see the setters.
 * Method   Max 1994 eq. 1 for each hit: optical depth -log(1 - opacity), radiance opacity * colour, so that
 *          L = opacity colour + (1 - opacity) L_behind. Colour by Gardner 1985 eq. 8 (nephoscope::SurfaceShade).
 *          The texture is nephoscope::CloudTexture, evaluated for each hit; its footprint is that of the pixel on the
 *          slanted surface. Gardner's eq. 11 frays the outline of ellipsoids; here g = (n . v)^2, which is the same for a
 *          sphere seen from afar.
 * Errors   input that is not vtkPolyData, or that has over 2^32 points or corners, a cylindrical camera: vtkErrorMacro, nothing is drawn.
 * Cost     O(points + triangles + hits); sorting and emission are parallel, copying the triangles is not. About 100
 *          bytes a point and 40 bytes a visible triangle.
 * Limits   vertices, lines and strips are ignored; triangles with a corner that is not finite, or without an area on
 *          the screen, are skipped. What is nearer than 1e-9 scene units to a perspective eye is not seen.
 * @sa vtkCloudscape, nephoscope::CloudTexture, nephoscope::ScreenTriangle
 */
#ifndef vtkCloudSurface_h
#define vtkCloudSurface_h

#include "vtkCloudLitBody.h"
#include "vtkCloudRenderingModule.h" // for export macro

#include <memory> // for members

class VTKCLOUDRENDERING_EXPORT vtkCloudSurface : public vtkCloudLitBody
{
public:
  static vtkCloudSurface* New();
  vtkTypeMacro(vtkCloudSurface, vtkCloudLitBody);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Where the opacity comes from; Opacity multiplies it.
  enum OpacityModes
  {
    UniformOpacity = 0,     ///< Opacity alone
    OpacityFromArray = 1,   ///< the point array Opacity, interpolated
    OpacityFromTexture = 2, ///< the transparency texture, for each hit
  };
  ///@{
  /// Where the opacity comes from. Default UniformOpacity.
  vtkSetClampMacro(OpacityMode, int, UniformOpacity, OpacityFromTexture);
  vtkGetMacro(OpacityMode, int);
  void SetOpacityModeToUniform() { this->SetOpacityMode(UniformOpacity); }
  void SetOpacityModeToArray() { this->SetOpacityMode(OpacityFromArray); }
  void SetOpacityModeToTexture() { this->SetOpacityMode(OpacityFromTexture); }
  ///@}

  ///@{
  /// Largest opacity, 0 to 1. Default 1.
  vtkSetClampMacro(Opacity, double, 0, 1);
  vtkGetMacro(Opacity, double);
  ///@}
  ///@{
  /// Reflectance, linear RGB. Default (1, 1, 1).
  vtkSetVector3Macro(Color, double);
  vtkGetVector3Macro(Color, double);
  ///@}
  ///@{
  /// Draw triangles that face away too, lit on the side that is seen. Default off.
  vtkSetMacro(BackFaces, bool);
  vtkGetMacro(BackFaces, bool);
  vtkBooleanMacro(BackFaces, bool);
  ///@}

  ///@{
  /// How far the sun's light creeps round the body, 0 (Lambert) to 1 (all round). Default 0.25.
  vtkSetClampMacro(Wrap, double, 0, 1);
  vtkGetMacro(Wrap, double);
  ///@}
  ///@{
  /// Gardner's t, the texture's share of the shading, 0 to 1; for OpacityFromTexture only. Default 0.2.
  vtkSetClampMacro(TextureShading, double, 0, 1);
  vtkGetMacro(TextureShading, double);
  ///@}
  ///@{
  /// Gardner's s, the share of specular reflection, 0 to 1, and its exponent. Default 0 and 10.
  vtkSetClampMacro(Specular, double, 0, 1);
  vtkGetMacro(Specular, double);
  vtkSetClampMacro(SpecularPower, double, 1, 1000);
  vtkGetMacro(SpecularPower, double);
  ///@}

  ///@{
  /// Wavelength of the texture's first term, m, > 0. Default 1.5e6.
  vtkSetMacro(TextureWavelength, double);
  vtkGetMacro(TextureWavelength, double);
  ///@}
  ///@{
  /// Number of the texture's terms, 1 to 8. Default 7.
  vtkSetClampMacro(TextureOctaves, int, 1, 8);
  vtkGetMacro(TextureOctaves, int);
  ///@}
  ///@{
  /// Gardner's T0, >= 0: large fills the gaps. Default 0.22.
  vtkSetMacro(TextureOffset, double);
  vtkGetMacro(TextureOffset, double);
  ///@}
  ///@{
  /// Gardner's T1: below it the surface is clear. Default 0.03.
  vtkSetMacro(TextureThreshold, double);
  vtkGetMacro(TextureThreshold, double);
  ///@}
  ///@{
  /// Gardner's T2: takes the threshold's place towards the outline. Default 0.1, which frays it a little; on a
  /// globe seen from space all that is near its limb is near the outline.
  vtkSetMacro(TextureRimThreshold, double);
  vtkGetMacro(TextureRimThreshold, double);
  ///@}
  ///@{
  /// Gardner's D, > 0: from clear to opaque. Default 0.25.
  vtkSetMacro(TextureRange, double);
  vtkGetMacro(TextureRange, double);
  ///@}
  ///@{
  /// What makes textures with equal parameters different. Default 1.
  vtkSetMacro(TextureSeed, int);
  vtkGetMacro(TextureSeed, int);
  ///@}

  bool DrawsPieces() const override { return true; }

#ifndef __VTK_WRAP__
  bool Prepare(const nephoscope::Camera& camera) override;
  void Emit(const nephoscope::Camera& camera, nephoscope::DeepTile& tile) const override;
#endif
  bool IsOpaque() const override;
  vtkIdType GetNumberOfDrawnCells() const override;

protected:
  vtkCloudSurface();
  ~vtkCloudSurface() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;

private:
  vtkCloudSurface(const vtkCloudSurface&) = delete;
  void operator=(const vtkCloudSurface&) = delete;

  int OpacityMode = UniformOpacity;
  double Opacity = 1;
  double Color[3] = { 1, 1, 1 };
  bool BackFaces = false;
  double Wrap = 0.25;
  double TextureShading = 0.2;
  double Specular = 0;
  double SpecularPower = 10;
  double TextureWavelength = 1.5e6;
  int TextureOctaves = 7;
  double TextureOffset = 0.22;
  double TextureThreshold = 0.03;
  double TextureRimThreshold = 0.1;
  double TextureRange = 0.25;
  int TextureSeed = 1;

  struct Drawing;
  std::unique_ptr<Drawing> Ready;
};
#endif
