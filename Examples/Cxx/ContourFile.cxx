// SPDX-License-Identifier: BSD-3-Clause
// Contours a model's cloud fraction at 15 % and writes the surface: ContourFile CLIMATE.nc OUT.vtp
#include <vtkCloudContour.h>
#include <vtkCloudNetCDFReader.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

int main(int argc, char* argv[])
{
  if (argc != 3)
  {
    return 2;
  }
  const vtkNew<vtkCloudNetCDFReader> reader;
  reader->SetFileName(argv[1]);
  reader->SetVerticalExaggeration(30);
  const vtkNew<vtkCloudContour> contour;
  contour->SetInputConnection(reader->GetOutputPort());
  contour->SetValue(0, 0.15);
  const vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputConnection(contour->GetOutputPort());
  writer->SetFileName(argv[2]);
  return writer->Write() && contour->GetOutput()->GetNumberOfPolys() > 0 ? 0 : 1;
}
