// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCloudContour.h"

#include "CloudArrays.h"
#include "ContourOutput.h"
#include "LatticeContour.h"
#include "LatticeGrid.h"
#include "LatticeRanges.h"
#include "TetrahedraSurface.h"
#include "WholeData.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkDataSet.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnstructuredGrid.h"

#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <tuple>
#include <type_traits>

vtkStandardNewMacro(vtkCloudContour);

/// What one update leaves for the next: the field's ranges and the output's arrays, to write into again.
class vtkCloudContour::vtkInternals
{
public:
  nephoscope::ContourArrays Arrays;

  /// Those of the field as it is now, worked out if it is not as it was.
  template <class T>
  const nephoscope::LatticeRanges<T>& RangesOf(
    vtkDataArray* field, const T* values, const nephoscope::LatticeShape& shape)
  {
    auto& ranges = std::get<std::unique_ptr<nephoscope::LatticeRanges<T>>>(this->Ranges);
    if (!ranges || this->Field != field || this->Time != field->GetMTime() || this->N != shape.n)
    {
      this->Ranges = {};
      ranges = std::make_unique<nephoscope::LatticeRanges<T>>(shape, values);
      this->Field = field;
      this->Time = field->GetMTime();
      this->N = shape.n;
    }
    return *ranges;
  }

private:
  const vtkDataArray* Field = nullptr; // to compare only; times never come twice
  vtkMTimeType Time = 0;
  std::array<int, 3> N{ 0, 0, 0 };
  std::tuple<std::unique_ptr<nephoscope::LatticeRanges<float>>,
    std::unique_ptr<nephoscope::LatticeRanges<double>>>
    Ranges;
};

namespace
{
using nephoscope::ContourArrays;
using nephoscope::ContourOutput;
using nephoscope::isHidden;
using nephoscope::LatticeContour;
using nephoscope::LatticeShape;
using nephoscope::OrientedTetrahedron;
using nephoscope::TetrahedraSurface;
using nephoscope::Vector3;

/// What the two kinds of grid have in common when they are contoured.
struct Request
{
  vtkCloudContour* Filter;
  vtkDataSet* Input;
  vtkPolyData* Output;
  vtkDataArray* Field;
  const std::vector<double>& Values;
  bool Normals;
  ContourArrays& Kept;

  bool Aborted(double progress) const
  {
    this->Filter->UpdateProgress(progress);
    return this->Filter->GetAbortExecute() != 0;
  }
};

/// Attaches the arrays and keeps them for the next update, unless outputs are to be released.
void finish(const Request& request, const ContourOutput& out)
{
  attach(out, request.Output);
  request.Kept = request.Filter->GetReleaseDataFlag() ? ContourArrays() : ContourArrays(out);
}

template <class Points, class T>
void contourLattice(const Request& request, const Points& points, const T* values,
  const nephoscope::LatticeRanges<T>& ranges)
{
  const LatticeShape shape = nephoscope::latticeShape(request.Input);
  LatticeContour<Points, T> contour(request.Input, shape, points, values, ranges);
  contour.FindUsable();
  if (nephoscope::closesOnItself(shape, points) && contour.SeamValuesAgree() &&
    !contour.CloseSeam())
  {
    vtkWarningWithObjectMacro(request.Filter,
      "The grid closes on itself with an odd number of cells (" << shape.n[0] -
          1 << "), so the surface is open at the seam; an even number would close it.");
  }
  contour.Count(request.Values);
  if (request.Aborted(0.3))
  {
    return;
  }
  ContourOutput out(request.Kept);
  allocate(out, request.Input, request.Output, request.Field,
    std::is_same<typename Points::Real, double>::value, request.Normals,
    contour.GetNumberOfVertices(), contour.GetNumberOfTriangles());
  contour.Generate(out);
  finish(request, out);
}

template <class T>
void contourLatticeOf(
  const Request& request, const T* values, const nephoscope::LatticeRanges<T>& ranges)
{
  if (auto* grid = vtkStructuredGrid::SafeDownCast(request.Input))
  {
    const std::array<int, 3> n = nephoscope::latticeShape(grid).n;
    vtkDataArray* data = grid->GetPoints()->GetData();
    if (auto* floats = vtkAOSDataArrayTemplate<float>::FastDownCast(data))
    {
      contourLattice(
        request, nephoscope::CurvilinearPoints<float>{ floats->GetPointer(0), n }, values, ranges);
      return;
    }
    vtkSmartPointer<vtkDataArray> doubles = data;
    if (!vtkAOSDataArrayTemplate<double>::FastDownCast(data))
    {
      doubles = vtkSmartPointer<vtkDoubleArray>::New();
      doubles->DeepCopy(data);
    }
    contourLattice(request,
      nephoscope::CurvilinearPoints<double>{
        vtkAOSDataArrayTemplate<double>::FastDownCast(doubles)->GetPointer(0), n },
      values, ranges);
  }
  else if (auto* rectilinear = vtkRectilinearGrid::SafeDownCast(request.Input))
  {
    contourLattice(request, nephoscope::productPoints(rectilinear), values, ranges);
  }
  else
  {
    contourLattice(request, nephoscope::productPoints(vtkImageData::SafeDownCast(request.Input)),
      values, ranges);
  }
}

Vector3 pointOf(vtkPoints* points, vtkIdType id)
{
  Vector3 x;
  points->GetPoint(id, x.v);
  return x;
}

/// The usable tetrahedra, each turned so that its volume is not negative; false at a cell of another kind.
template <class T>
bool usableTetrahedra(
  vtkUnstructuredGrid* grid, const T* values, std::vector<OrientedTetrahedron>& tetrahedra)
{
  vtkUnsignedCharArray* pointGhosts = grid->GetPointGhostArray();
  vtkUnsignedCharArray* cellGhosts = grid->GetCellGhostArray();
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
  {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    grid->GetCellPoints(cell, count, ids);
    if (grid->GetCellType(cell) != VTK_TETRA || count != 4)
    {
      return false;
    }
    OrientedTetrahedron t = { ids[0], ids[1], ids[2], ids[3] };
    bool usable = !isHidden(
      cellGhosts, cell, vtkDataSetAttributes::HIDDENCELL | vtkDataSetAttributes::DUPLICATECELL);
    for (vtkIdType p : t)
    {
      usable = usable && std::isfinite(values[p]) &&
        !isHidden(pointGhosts, p, vtkDataSetAttributes::HIDDENPOINT);
    }
    if (usable)
    {
      const Vector3 x = pointOf(grid->GetPoints(), t[0]);
      const Vector3 a = pointOf(grid->GetPoints(), t[1]) - x;
      const Vector3 b = pointOf(grid->GetPoints(), t[2]) - x;
      const Vector3 c = pointOf(grid->GetPoints(), t[3]) - x;
      if (dot(a, cross(b, c)) < 0)
      {
        std::swap(t[2], t[3]);
      }
      tetrahedra.push_back(t);
    }
  }
  return true;
}

template <class T>
void writeTetrahedraVertices(const Request& request, ContourOutput& out,
  const TetrahedraSurface& surface, double value, vtkIdType first, const T* values,
  const std::vector<Vector3>& gradients)
{
  vtkPoints* points = vtkUnstructuredGrid::SafeDownCast(request.Input)->GetPoints();
  for (std::size_t v = 0; v < surface.Vertices.size(); ++v)
  {
    const nephoscope::CrossedEdge& e = surface.Vertices[v];
    const vtkIdType id = first + static_cast<vtkIdType>(v);
    const double fa = static_cast<double>(values[e.from]);
    const double fb = static_cast<double>(values[e.to]);
    const double t = nephoscope::crossing(fa, fb, value);
    const Vector3 a = pointOf(points, e.from);
    const Vector3 edge = pointOf(points, e.to) - a;
    const Vector3 x = a + t * edge;
    out.Points->SetTuple(id, x.v);
    out.Field->SetComponent(id, 0, value);
    out.Others.InterpolateEdge(e.from, e.to, t, id);
    if (out.Normals)
    {
      const Vector3 gradient = (1 - t) * gradients[e.from] + t * gradients[e.to];
      out.Normals->SetTuple(
        id, nephoscope::outwardNormal(gradient, fa > fb ? edge : -1.0 * edge, std::abs(fa - fb)).v);
    }
  }
}

template <class T>
int contourTetrahedra(const Request& request, const T* values)
{
  auto* grid = vtkUnstructuredGrid::SafeDownCast(request.Input);
  std::vector<OrientedTetrahedron> tetrahedra;
  if (!usableTetrahedra(grid, values, tetrahedra))
  {
    vtkErrorWithObjectMacro(request.Filter,
      "The unstructured grid has cells that are not tetrahedra; vtkDataSetTriangleFilter makes "
      "tetrahedra of them.");
    return 0;
  }
  std::vector<TetrahedraSurface> surfaces;
  vtkIdType vertices = 0;
  vtkIdType corners = 0;
  for (double value : request.Values)
  {
    surfaces.push_back(nephoscope::contourTetrahedra(tetrahedra, values, value));
    vertices += static_cast<vtkIdType>(surfaces.back().Vertices.size());
    corners += static_cast<vtkIdType>(surfaces.back().Triangles.size());
  }
  if (request.Aborted(0.6))
  {
    return 1;
  }
  ContourOutput out(request.Kept);
  allocate(out, grid, request.Output, request.Field, grid->GetPoints()->GetDataType() == VTK_DOUBLE,
    request.Normals, vertices, corners / 3);
  std::vector<Vector3> gradients;
  if (request.Normals)
  {
    gradients = nephoscope::tetrahedraGradients(tetrahedra, grid->GetNumberOfPoints(), values,
      [grid](vtkIdType id) { return pointOf(grid->GetPoints(), id); });
  }
  vtkIdType firstVertex = 0;
  vtkIdType corner = 0;
  for (std::size_t s = 0; s < surfaces.size(); ++s)
  {
    writeTetrahedraVertices(
      request, out, surfaces[s], request.Values[s], firstVertex, values, gradients);
    withIds(out,
      [&surfaces, s, firstVertex, &corner](auto* ids, auto* offsets)
      {
        using Id = std::remove_pointer_t<decltype(ids)>;
        for (vtkIdType id : surfaces[s].Triangles)
        {
          offsets[corner / 3] = static_cast<Id>(corner / 3 * 3);
          ids[corner++] = static_cast<Id>(firstVertex + id);
        }
      });
    firstVertex += static_cast<vtkIdType>(surfaces[s].Vertices.size());
  }
  finish(request, out);
  return 1;
}

template <class T, class Internals>
int contour(const Request& request, const T* values, Internals& internals)
{
  if (request.Input->IsA("vtkUnstructuredGrid"))
  {
    return contourTetrahedra(request, values);
  }
  contourLatticeOf(request, values,
    internals.RangesOf(request.Field, values, nephoscope::latticeShape(request.Input)));
  return 1;
}
}

vtkCloudContour::vtkCloudContour()
  : Values(1, 0.15)
  , Internals(std::make_unique<vtkInternals>())
{
  this->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, nephoscope::arrays::CloudFraction);
}

vtkCloudContour::~vtkCloudContour() = default;

void vtkCloudContour::SetValue(int i, double value)
{
  if (i < 0 || i > 65535)
  {
    vtkErrorMacro("Contour value number " << i << " is out of range 0 to 65535.");
    return;
  }
  if (i >= this->GetNumberOfContours())
  {
    this->Values.resize(i + 1, 0.0);
  }
  else if (this->Values[i] == value)
  {
    return;
  }
  this->Values[i] = value;
  this->Modified();
}

double vtkCloudContour::GetValue(int i) const
{
  return i >= 0 && i < this->GetNumberOfContours() ? this->Values[i] : 0.0;
}

void vtkCloudContour::SetNumberOfContours(int number)
{
  const int wanted = std::min(std::max(number, 0), 65536);
  if (wanted != this->GetNumberOfContours())
  {
    this->Values.resize(wanted, 0.0);
    this->Modified();
  }
}

int vtkCloudContour::GetNumberOfContours() const
{
  return static_cast<int>(this->Values.size());
}

void vtkCloudContour::GenerateValues(int number, double first, double last)
{
  this->SetNumberOfContours(number);
  const int count = this->GetNumberOfContours();
  for (int i = 0; i < count; ++i)
  {
    this->SetValue(i, count == 1 ? first : first + i * (last - first) / (count - 1));
  }
}

int vtkCloudContour::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkStructuredGrid");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkRectilinearGrid");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkUnstructuredGrid");
  return 1;
}

int vtkCloudContour::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  // The gradients on a piece's border are those of the whole with the points next to it.
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  vtkInformation* const out = outputVector->GetInformationObject(0);
  vtkInformation* const in = inputVector[0]->GetInformationObject(0);
  if (in && out->Get(Pipeline::UPDATE_NUMBER_OF_PIECES()) > 1)
  {
    in->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 1);
  }
  return 1;
}

vtkDataArray* vtkCloudContour::FindField(vtkDataSet* input, vtkInformationVector** inputVector)
{
  int association = vtkDataObject::FIELD_ASSOCIATION_POINTS;
  const char* wanted = this->GetInputArrayInformation(0)->Get(vtkDataObject::FIELD_NAME());
  vtkDataArray* field = wanted && !wanted[0]
    ? input->GetPointData()->GetArray(nephoscope::arrays::CloudFraction)
    : this->GetInputArrayToProcess(0, inputVector, association);
  if (!field)
  {
    std::string names;
    for (int a = 0; a < input->GetPointData()->GetNumberOfArrays(); ++a)
    {
      const char* name = input->GetPointData()->GetArrayName(a);
      names += std::string(a > 0 ? ", " : "") + (name ? name : "(no name)");
    }
    vtkErrorMacro("No point array '" << (wanted ? wanted : "") << "' to contour; the input has: "
                                     << (names.empty() ? "none" : names)
                                     << ". Choose one with SetInputArrayToProcess.");
    return nullptr;
  }
  const char* name = field->GetName() ? field->GetName() : "(no name)";
  if (association != vtkDataObject::FIELD_ASSOCIATION_POINTS)
  {
    vtkErrorMacro(
      "Array '" << name << "' is not a point array; vtkCellDataToPointData makes one of it.");
    return nullptr;
  }
  if (field->GetNumberOfComponents() != 1)
  {
    vtkErrorMacro("Array '" << name << "' has " << field->GetNumberOfComponents()
                            << " components; a contour needs one.");
    return nullptr;
  }
  return field;
}

bool vtkCloudContour::CheckValues()
{
  for (double value : this->Values)
  {
    if (!std::isfinite(value))
    {
      vtkErrorMacro("Contour value " << value << " is not finite; give a number.");
      return false;
    }
  }
  return true;
}

int vtkCloudContour::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkDataSet* input = vtkDataSet::GetData(inputVector[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  if (!input || input->GetNumberOfPoints() == 0)
  {
    return 1;
  }
  const std::string missing = nephoscope::whatIsMissing(input);
  if (!missing.empty())
  {
    vtkErrorMacro(<< missing);
    return 0;
  }
  vtkDataArray* field = this->FindField(input, inputVector);
  if (!field || !this->CheckValues())
  {
    return 0;
  }
  const std::array<int, 3> n = nephoscope::latticeShape(input).n;
  if (!input->IsA("vtkUnstructuredGrid") && std::min({ n[0], n[1], n[2] }) < 2)
  {
    return 1; // no cells with volume
  }

  const Request request{ this, input, output, field, this->Values, this->ComputeNormals,
    this->Internals->Arrays };
  if (auto* floats = vtkAOSDataArrayTemplate<float>::FastDownCast(field))
  {
    return contour(request, floats->GetPointer(0), *this->Internals);
  }
  vtkSmartPointer<vtkDataArray> doubles = field;
  if (!vtkAOSDataArrayTemplate<double>::FastDownCast(field))
  {
    doubles = vtkSmartPointer<vtkDoubleArray>::New();
    doubles->DeepCopy(field);
  }
  return contour(request, vtkAOSDataArrayTemplate<double>::FastDownCast(doubles)->GetPointer(0),
    *this->Internals);
}

void vtkCloudContour::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Values:";
  for (double value : this->Values)
  {
    os << ' ' << value;
  }
  os << '\n' << indent << "ComputeNormals: " << this->ComputeNormals << '\n';
}
