// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCloudSmooth.h"

#include "CloudArrays.h"
#include "LatticeGrid.h"
#include "LineDiffusion.h"
#include "PieceOfWhole.h"
#include "WholeData.h"

#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkSMPThreadLocal.h"
#include "vtkSMPTools.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <limits>

vtkStandardNewMacro(vtkCloudSmooth);

namespace
{
using nephoscope::DiffusionLine;
using nephoscope::Index;
using nephoscope::LatticeShape;
using nephoscope::Vector3;

/// The points of any structured data set.
struct AnyPoints
{
  vtkDataSet* Data;
  LatticeShape Shape;

  Vector3 operator()(int i, int j, int k) const
  {
    Vector3 x;
    this->Data->GetPoint(i + this->Shape.n[0] * (j + Index(this->Shape.n[1]) * k), x.v);
    return x;
  }
};

/// A grid as the smoothing sees it: areas and conductances between neighbours on a layer.
class LayerGeometry
{
public:
  explicit LayerGeometry(const AnyPoints& points)
    : Shape(points.Shape)
    , Area(Shape.rows() * Shape.n[0])
    , AlongI(Area.size())
    , AlongJ(Area.size())
  {
    this->Shape.closed = nephoscope::closesOnItself(points.Shape, points);
    vtkSMPTools::For(0, this->Shape.rows(),
      [this, &points](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType row = begin; row < end; ++row)
        {
          this->SetSteps(points, row);
        }
      });
    vtkSMPTools::For(0, this->Shape.n[2],
      [this](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType k = begin; k < end; ++k)
        {
          this->SetAreas(static_cast<int>(k));
        }
      });
  }

  /// Points of a row that are not another point again.
  int Columns() const { return this->Shape.n[0] - (this->Shape.closed ? 1 : 0); }
  Index Id(int i, int j, int k) const
  {
    return i + this->Shape.n[0] * (j + Index(this->Shape.n[1]) * k);
  }

  LatticeShape Shape;
  std::vector<double> Area;
  std::vector<double> AlongI; ///< conductance to the next point along i; at first, the step
  std::vector<double> AlongJ;

private:
  void SetSteps(const AnyPoints& points, Index row)
  {
    const int j = static_cast<int>(row % this->Shape.n[1]);
    const int k = static_cast<int>(row / this->Shape.n[1]);
    for (int i = 0; i < this->Shape.n[0]; ++i)
    {
      const Vector3 here = points(i, j, k);
      const Index id = row * this->Shape.n[0] + i;
      this->AlongI[id] =
        i + 1 < this->Shape.n[0] ? nephoscope::length(points(i + 1, j, k) - here) : 0;
      this->AlongJ[id] =
        j + 1 < this->Shape.n[1] ? nephoscope::length(points(i, j + 1, k) - here) : 0;
    }
  }

  /// Steps to areas and conductances, for one layer.
  void SetAreas(int k)
  {
    const int columns = this->Columns();
    const int rows = this->Shape.n[1];
    std::vector<double> widthI(std::size_t(columns) * rows);
    std::vector<double> widthJ(widthI.size());
    for (int j = 0; j < rows; ++j)
    {
      for (int i = 0; i < columns; ++i)
      {
        const int before = i > 0 ? i - 1 : columns - 1;
        const double stepBefore =
          i > 0 || this->Shape.closed ? this->AlongI[this->Id(before, j, k)] : 0;
        const double acrossBefore = j > 0 ? this->AlongJ[this->Id(i, j - 1, k)] : 0;
        double wi = (stepBefore + this->AlongI[this->Id(i, j, k)]) / 2;
        double wj = (acrossBefore + this->AlongJ[this->Id(i, j, k)]) / 2;
        wi = this->Shape.n[0] == 1 ? 1 : std::max(wi, 1e-3 * wj);
        wj = rows == 1 ? 1 : std::max(wj, 1e-3 * wi);
        widthI[i + std::size_t(columns) * j] = wi > 0 ? wi : 1;
        widthJ[i + std::size_t(columns) * j] = wj > 0 ? wj : 1;
      }
    }
    const auto at = [columns](const std::vector<double>& width, int i, int j)
    { return width[i % columns + std::size_t(columns) * j]; };
    for (int j = 0; j < rows; ++j)
    {
      for (int i = 0; i < columns; ++i)
      {
        const Index id = this->Id(i, j, k);
        this->Area[id] = at(widthI, i, j) * at(widthJ, i, j);
        const double acrossI = (at(widthJ, i, j) + at(widthJ, i + 1, j)) / 2;
        this->AlongI[id] = acrossI / std::max(this->AlongI[id], 1e-3 * acrossI);
        const int next = std::min(j + 1, rows - 1);
        const double acrossJ = (at(widthI, i, j) + at(widthI, i, next)) / 2;
        this->AlongJ[id] = acrossJ / std::max(this->AlongJ[id], 1e-3 * acrossJ);
      }
    }
  }
};

/// One component of a field on the layers.
class LayerSmoother
{
public:
  LayerSmoother(
    const LayerGeometry& geometry, vtkDataArray* field, int component, vtkUnsignedCharArray* ghosts)
    : Geometry(geometry)
    , Values(geometry.Area.size())
  {
    for (std::size_t id = 0; id < this->Values.size(); ++id)
    {
      const double value = field->GetComponent(static_cast<vtkIdType>(id), component);
      const bool hidden = ghosts &&
        (ghosts->GetValue(static_cast<vtkIdType>(id)) & vtkDataSetAttributes::HIDDENPOINT);
      this->Values[id] =
        std::isfinite(value) && !hidden ? value : std::numeric_limits<double>::quiet_NaN();
    }
  }

  void AlongI(double step)
  {
    vtkSMPThreadLocal<DiffusionLine> lines(DiffusionLine(this->Geometry.Columns()));
    vtkSMPTools::For(0, this->Geometry.Shape.rows(),
      [this, &lines, step](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType row = begin; row < end; ++row)
        {
          this->Diffuse(lines.Local(), row * this->Geometry.Shape.n[0], 1, this->Geometry.AlongI,
            step, this->Geometry.Shape.closed);
        }
      });
  }

  void AlongJ(double step)
  {
    const int columns = this->Geometry.Columns();
    vtkSMPThreadLocal<DiffusionLine> lines(DiffusionLine(this->Geometry.Shape.n[1]));
    vtkSMPTools::For(0, vtkIdType(columns) * this->Geometry.Shape.n[2],
      [this, &lines, columns, step](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType line = begin; line < end; ++line)
        {
          this->Diffuse(lines.Local(),
            this->Geometry.Id(
              static_cast<int>(line % columns), 0, static_cast<int>(line / columns)),
            this->Geometry.Shape.n[0], this->Geometry.AlongJ, step, false);
        }
      });
  }

  /// Writes what has a value; the rest of the array stays as it is.
  void Write(vtkDataArray* field, int component) const
  {
    const int last = this->Geometry.Shape.n[0] - 1;
    for (std::size_t id = 0; id < this->Values.size(); ++id)
    {
      const bool again = this->Geometry.Shape.closed && static_cast<int>(id % (last + 1)) == last;
      const double value = this->Values[again ? id - last : id];
      if (!std::isnan(value))
      {
        field->SetComponent(static_cast<vtkIdType>(id), component, value);
      }
    }
  }

private:
  void Diffuse(DiffusionLine& line, Index first, Index stride,
    const std::vector<double>& conductance, double step, bool ring)
  {
    for (int n = 0; n < line.size(); ++n)
    {
      const Index id = first + n * stride;
      line.value[n] = this->Values[id];
      line.capacity[n] = this->Geometry.Area[id];
      line.conductance[n] = conductance[id];
    }
    line.diffuse(step, ring);
    for (int n = 0; n < line.size(); ++n)
    {
      this->Values[first + n * stride] = line.value[n];
    }
  }

  const LayerGeometry& Geometry;
  std::vector<double> Values;
};

vtkSmartPointer<vtkDataArray> realCopy(vtkDataArray* field)
{
  vtkSmartPointer<vtkDataArray> copy;
  if (field->GetDataType() == VTK_DOUBLE)
  {
    copy = vtkSmartPointer<vtkDoubleArray>::New();
  }
  else
  {
    copy = vtkSmartPointer<vtkFloatArray>::New();
  }
  copy->DeepCopy(field);
  copy->SetName(field->GetName());
  return copy;
}
}

vtkCloudSmooth::vtkCloudSmooth() = default;

vtkCloudSmooth::~vtkCloudSmooth() = default;

void vtkCloudSmooth::AddSmoothedArray(const char* name)
{
  if (name)
  {
    this->Names.emplace_back(name);
    this->Modified();
  }
}

void vtkCloudSmooth::ClearSmoothedArrays()
{
  this->Names.clear();
  this->Modified();
}

int vtkCloudSmooth::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkStructuredGrid");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkRectilinearGrid");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

int vtkCloudSmooth::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  nephoscope::askForWhole(inputVector[0]->GetInformationObject(0));
  return 1;
}

int vtkCloudSmooth::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkDataSet* input = vtkDataSet::GetData(inputVector[0]);
  vtkDataSet* output = vtkDataSet::GetData(outputVector);
  if (!input || !output || input->GetNumberOfPoints() == 0)
  {
    return 1;
  }
  if (!this->Smooth(input, output))
  {
    return 0;
  }
  nephoscope::cutPiece(output, outputVector->GetInformationObject(0));
  return 1;
}

bool vtkCloudSmooth::Smooth(vtkDataSet* input, vtkDataSet* output)
{
  const std::string missing = nephoscope::whatIsMissing(input);
  if (!missing.empty())
  {
    vtkErrorMacro(<< missing);
    return false;
  }
  std::vector<std::string> names = this->Names;
  if (names.empty())
  {
    names.emplace_back(nephoscope::arrays::CloudFraction);
  }
  for (const std::string& name : names)
  {
    if (!input->GetPointData()->GetArray(name.c_str()))
    {
      vtkErrorMacro("No point array '"
        << name << "' to smooth; name one that the input has with AddSmoothedArray.");
      return false;
    }
  }
  output->ShallowCopy(input);
  if (this->Length == 0)
  {
    return true;
  }

  const LayerGeometry geometry(AnyPoints{ input, nephoscope::latticeShape(input) });
  const double step = this->Length * this->Length / (2 * this->Passes);
  for (std::size_t n = 0; n < names.size() && !this->GetAbortExecute(); ++n)
  {
    vtkDataArray* field = input->GetPointData()->GetArray(names[n].c_str());
    vtkSmartPointer<vtkDataArray> smooth = realCopy(field);
    for (int component = 0; component < field->GetNumberOfComponents(); ++component)
    {
      LayerSmoother smoother(geometry, field, component, input->GetPointGhostArray());
      for (int pass = 0; pass < this->Passes; ++pass)
      {
        smoother.AlongJ(step);
        smoother.AlongI(step); // last, for it makes a pole's row one value
      }
      smoother.Write(smooth, component);
    }
    output->GetPointData()->AddArray(smooth);
    this->UpdateProgress(double(n + 1) / names.size());
  }
  return true;
}

void vtkCloudSmooth::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Length: " << this->Length << '\n'
     << indent << "Passes: " << this->Passes << '\n';
  for (const std::string& name : this->Names)
  {
    os << indent << "Smoothed array: " << name << '\n';
  }
}
