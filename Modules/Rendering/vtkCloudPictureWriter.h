// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCloudPictureWriter
 * @brief Writes a picture of vtkCloudscape as PNG, to look at, or OpenEXR, to work on.
 *
 * Input    port 0, vtkImageData (2-D) with point arrays
 *            Radiance       3 components, linear RGB     required
 *            Transmittance  3 components, 0..1           optional, OpenEXR only
 *            Depth          1 component, scene units     optional, OpenEXR only
 * Output   a file; the name's extension decides, in upper or lower case:
 *            .png   8-bit sRGB (IEC 61966-2-1) of shoulder(2^Exposure radiance), row 0 of the image at the bottom
 *            .exr   channels R G B linear, untouched by Exposure and Shoulder; T.R T.G T.B; Z (always float).
 *                   zip compressed
 *          It is written beside under another name and renamed, so that there is never a part of a file.
 * Parameters: see the setters.
 * Errors   no file name, unknown extension, no Radiance, no pixels, a folder or disk that cannot be written:
 *          vtkErrorMacro with file and cause, Write returns 0, an older file of that name stays as it was.
 * Limits   NaN is black in a PNG.
 * @sa vtkCloudscape, nephoscope::srgb
 */
#ifndef vtkCloudPictureWriter_h
#define vtkCloudPictureWriter_h

#include "vtkCloudRenderingModule.h" // for export macro
#include "vtkWriter.h"

class vtkImageData;

class VTKCLOUDRENDERING_EXPORT vtkCloudPictureWriter : public vtkWriter
{
public:
  static vtkCloudPictureWriter* New();
  vtkTypeMacro(vtkCloudPictureWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// The file, with the extension .png or .exr.
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}
  ///@{
  /// Exposure of a PNG in stops: radiance is multiplied by 2^Exposure. Default 0.
  vtkSetMacro(Exposure, double);
  vtkGetMacro(Exposure, double);
  ///@}
  ///@{
  /// How much of a PNG's range is for highlights, 0 to 1: above 1 - Shoulder light is bent so that it never clips.
  /// Default 0: light above 1 clips.
  vtkSetClampMacro(Shoulder, double, 0, 1);
  vtkGetMacro(Shoulder, double);
  ///@}
  ///@{
  /// Write R G B and T of an OpenEXR file as 32-bit floats in place of 16-bit ones. Default off.
  vtkSetMacro(FullFloat, bool);
  vtkGetMacro(FullFloat, bool);
  vtkBooleanMacro(FullFloat, bool);
  ///@}

  /// Write the file. 1 if all went well.
  int Write() override;

protected:
  vtkCloudPictureWriter() = default;
  ~vtkCloudPictureWriter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  void WriteData() override;

  char* FileName = nullptr;
  double Exposure = 0;
  double Shoulder = 0;
  bool FullFloat = false;

private:
  vtkCloudPictureWriter(const vtkCloudPictureWriter&) = delete;
  void operator=(const vtkCloudPictureWriter&) = delete;

  void Fail(const char* cause);
  void WritePNG(vtkImageData* picture, const char* path) const;
  void WriteEXR(vtkImageData* picture, const char* path) const;
};
#endif
