// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCloudContour.h"

#include "CloudArrays.h"
#include "LatticeGrid.h"
#include "LatticeSurface.h"
#include "TetrahedraSurface.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkArrayListTemplate.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSMPThreadLocal.h"
#include "vtkSMPTools.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <cmath>
#include <limits>
#include <memory>
#include <string>

vtkStandardNewMacro(vtkCloudContour);

namespace
{
using nephoscope::ContourLevel;
using nephoscope::Index;
using nephoscope::LatticeBits;
using nephoscope::LatticeField;
using nephoscope::LatticeShape;
using nephoscope::OrientedTetrahedron;
using nephoscope::TetrahedraSurface;
using nephoscope::Vector3;

/// The output while it is written: arrays of their final size, and the other point arrays to interpolate.
struct Output
{
  vtkSmartPointer<vtkDataArray> Points;
  vtkSmartPointer<vtkFloatArray> Normals;
  vtkSmartPointer<vtkDataArray> Field;
  vtkSmartPointer<vtkDataArray> Connectivity;
  vtkSmartPointer<vtkDataArray> Offsets;
  ArrayList Others;
};

template <class ArrayType>
vtkSmartPointer<ArrayType> newArray(int components, vtkIdType tuples)
{
  auto array = vtkSmartPointer<ArrayType>::New();
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  return array;
}

vtkSmartPointer<vtkDataArray> newRealArray(bool isDouble, int components, vtkIdType tuples)
{
  if (isDouble)
  {
    return newArray<vtkDoubleArray>(components, tuples);
  }
  return newArray<vtkFloatArray>(components, tuples);
}

vtkSmartPointer<vtkDataArray> newIdArray(bool isLong, vtkIdType tuples)
{
  if (isLong)
  {
    return newArray<vtkTypeInt64Array>(1, tuples);
  }
  return newArray<vtkTypeInt32Array>(1, tuples);
}

void allocate(Output& out, vtkDataSet* input, vtkPolyData* output, vtkDataArray* field,
  bool doublePoints, bool normals, vtkIdType vertices, vtkIdType triangles)
{
  vtkPointData* in = input->GetPointData();
  vtkPointData* attributes = output->GetPointData();
  attributes->CopyNormalsOff();
  attributes->CopyFieldOff(vtkDataSetAttributes::GhostArrayName());
  if (field->GetName())
  {
    attributes->CopyFieldOff(field->GetName());
  }
  attributes->InterpolateAllocate(in, vertices);
  out.Others.ExcludeArray(field);
  out.Others.AddArrays(vertices, in, attributes);

  out.Points = newRealArray(doublePoints, 3, vertices);
  out.Field = newRealArray(field->GetDataType() == VTK_DOUBLE, 1, vertices);
  out.Field->SetName(field->GetName());
  attributes->SetScalars(out.Field);
  if (normals)
  {
    out.Normals = newArray<vtkFloatArray>(3, vertices);
    out.Normals->SetName("Normals");
    attributes->SetNormals(out.Normals);
  }
  const bool isLong = 3 * triangles > std::numeric_limits<vtkTypeInt32>::max();
  out.Connectivity = newIdArray(isLong, 3 * triangles);
  out.Offsets = newIdArray(isLong, triangles + 1);
}

/// Calls write(connectivity, offsets) with pointers of the right type.
template <class F>
void withIds(Output& out, F&& write)
{
  if (auto* small = vtkTypeInt32Array::SafeDownCast(out.Connectivity))
  {
    write(small->GetPointer(0), vtkTypeInt32Array::SafeDownCast(out.Offsets)->GetPointer(0));
  }
  else
  {
    write(vtkTypeInt64Array::SafeDownCast(out.Connectivity)->GetPointer(0),
      vtkTypeInt64Array::SafeDownCast(out.Offsets)->GetPointer(0));
  }
}

void attach(Output& out, vtkPolyData* output)
{
  const vtkIdType triangles = out.Offsets->GetNumberOfTuples() - 1;
  out.Offsets->SetComponent(triangles, 0, static_cast<double>(3 * triangles));
  vtkNew<vtkPoints> points;
  points->SetData(out.Points);
  output->SetPoints(points);
  vtkNew<vtkCellArray> cells;
  cells->SetData(out.Offsets, out.Connectivity);
  output->SetPolys(cells);
}

template <class T>
struct ArrayOf;
template <>
struct ArrayOf<float>
{
  using Type = vtkFloatArray;
};
template <>
struct ArrayOf<double>
{
  using Type = vtkDoubleArray;
};

/// The least T that is not below the value: x >= value as real numbers if and only if x >= this.
template <class T>
T threshold(double value)
{
  const double largest = std::numeric_limits<T>::max();
  if (value > largest)
  {
    return std::numeric_limits<T>::infinity();
  }
  const T near = static_cast<T>(std::max(value, -largest));
  return near < value ? std::nextafter(near, std::numeric_limits<T>::infinity()) : near;
}

bool isHidden(vtkUnsignedCharArray* ghosts, vtkIdType id, unsigned char flags)
{
  return ghosts && (ghosts->GetValue(id) & flags) != 0;
}

/// The surfaces of one lattice; its members are the passes, in order.
template <class Points, class T>
class LatticeContour
{
public:
  LatticeContour(
    vtkDataSet* input, const LatticeShape& shape, const Points& points, const T* values)
    : Input(input)
    , Shape(shape)
    , X(points)
    , Values(values)
  {
  }

  /// Notes unusable points and cells, if there are any.
  void FindUsable()
  {
    vtkUnsignedCharArray* pointGhosts = this->Input->GetPointGhostArray();
    vtkUnsignedCharArray* cellGhosts = this->Input->GetCellGhostArray();
    if (!pointGhosts && !cellGhosts && this->AllFinite())
    {
      return;
    }
    this->Usable = std::make_unique<LatticeBits>(this->Shape);
    this->Cells = std::make_unique<LatticeBits>(this->Shape);
    const auto& n = this->Shape.n;
    for (Index row = 0; row < this->Shape.rows(); ++row)
    {
      const Index firstCell = row % n[1] + Index(n[1] - 1) * (row / n[1]);
      const bool hasCells = row % n[1] < n[1] - 1 && row / n[1] < n[2] - 1;
      for (int i = 0; i < n[0]; ++i)
      {
        const nephoscope::Bits bit = nephoscope::Bits(1) << (i % 64);
        const Index id = row * n[0] + i;
        if (std::isfinite(this->Values[id]) &&
          !isHidden(pointGhosts, id, vtkDataSetAttributes::HIDDENPOINT))
        {
          this->Usable->row(row)[i / 64] |= bit;
        }
        if (hasCells && i < n[0] - 1 &&
          !isHidden(cellGhosts, firstCell * (n[0] - 1) + i,
            vtkDataSetAttributes::HIDDENCELL | vtkDataSetAttributes::DUPLICATECELL))
        {
          this->Cells->row(row)[i / 64] |= bit;
        }
      }
    }
    for (Index row = 0; row < this->Shape.rows(); ++row)
    {
      restrictToUsablePoints(this->Shape, *this->Usable, row, *this->Cells);
    }
  }

  void CloseSeam() { this->Shape.closed = true; }

  /// Whether every row ends with the value and the usability it starts with.
  bool SeamValuesAgree() const
  {
    const int last = this->Shape.n[0] - 1;
    for (Index row = 0; row < this->Shape.rows(); ++row)
    {
      const bool usable = !this->Usable || this->Usable->test(row, 0);
      const bool usableEnd = !this->Usable || this->Usable->test(row, last);
      const T* values = this->Values + row * this->Shape.n[0];
      if (usable != usableEnd || (usable && values[0] != values[last]))
      {
        return false;
      }
    }
    return true;
  }

  void Count(double value)
  {
    this->Levels.push_back(std::make_unique<ContourLevel>(this->Shape, this->Cells.get()));
    this->LevelValues.push_back(value);
    ContourLevel* level = this->Levels.back().get();
    const T limit = threshold<T>(value);
    vtkSMPTools::For(0, this->Shape.rows(),
      [this, level, limit](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType row = begin; row < end; ++row)
        {
          level->classify(row, this->Values + row * this->Shape.n[0], limit);
        }
      });
    vtkSMPTools::For(0, this->Shape.rows(),
      [level](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType row = begin; row < end; ++row)
        {
          level->countRow(row);
        }
      });
    level->accumulate();
    this->Vertices += level->numberOfVertices();
    this->Triangles += level->numberOfTriangles();
  }

  vtkIdType GetNumberOfVertices() const { return this->Vertices; }
  vtkIdType GetNumberOfTriangles() const { return this->Triangles; }

  void Generate(Output& out)
  {
    const bool flip = nephoscope::leftHanded(this->Shape, this->X);
    vtkIdType firstVertex = 0;
    vtkIdType firstTriangle = 0;
    for (std::size_t l = 0; l < this->Levels.size(); ++l)
    {
      this->GenerateVertices(out, *this->Levels[l], this->LevelValues[l], firstVertex);
      withIds(out,
        [this, l, flip, firstVertex, firstTriangle](auto* ids, auto* offsets) {
          this->GenerateTriangles(*this->Levels[l], flip, firstVertex, firstTriangle, ids, offsets);
        });
      firstVertex += this->Levels[l]->numberOfVertices();
      firstTriangle += this->Levels[l]->numberOfTriangles();
    }
  }

private:
  bool AllFinite() const
  {
    // x * 0 is NaN for what is not finite; four sums so that the additions overlap.
    T sums[4] = { 0, 0, 0, 0 };
    const Index count = this->Shape.rows() * this->Shape.n[0];
    for (Index n = 0; n < count; ++n)
    {
      sums[n % 4] += this->Values[n] * T(0);
    }
    return sums[0] + sums[1] + sums[2] + sums[3] == 0;
  }

  void GenerateVertices(Output& out, const ContourLevel& level, double value, vtkIdType first)
  {
    using Real = typename Points::Real;
    using Cache = nephoscope::GradientCache<Points, T>;
    const LatticeField<Points, T> field{ this->Shape, this->X, this->Values, this->Usable.get() };
    const nephoscope::SurfaceVertices<Real> vertices{
      ArrayOf<Real>::Type::SafeDownCast(out.Points)->GetPointer(3 * first),
      out.Normals ? out.Normals->GetPointer(3 * first) : nullptr
    };
    T* values = nullptr;
    if (auto* array = ArrayOf<T>::Type::SafeDownCast(out.Field))
    {
      values = array->GetPointer(first);
    }
    // Bands of rows along j over all k: gradients of a band's two levels stay in the cache.
    const int band = this->Shape.n[1] >= 64 ? 8 : 2;
    const vtkIdType bands = (this->Shape.n[1] + band - 1) / band;
    vtkSMPThreadLocal<Cache> caches;
    ArrayList& others = out.Others;
    vtkDataArray* slowValues = out.Field;
    vtkSMPTools::For(0, bands, 1,
      [this, &field, &level, &caches, &vertices, &others, values, slowValues, value, first, band](
        vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType b = begin; b < end; ++b)
        {
          const int j0 = static_cast<int>(b) * band;
          nephoscope::writeVertices(field, level, value, j0, std::min(j0 + band, this->Shape.n[1]),
            caches.Local(), vertices,
            [&others, values, slowValues, value, first](Index id, Index from, Index to, double t)
            {
              others.InterpolateEdge(from, to, t, first + id);
              if (values)
              {
                values[id] = static_cast<T>(value);
              }
              else
              {
                slowValues->SetComponent(first + id, 0, value);
              }
            });
        }
      });
  }

  template <class Id>
  void GenerateTriangles(const ContourLevel& level, bool flip, vtkIdType firstVertex,
    vtkIdType firstTriangle, Id* ids, Id* offsets) const
  {
    vtkSMPTools::For(0, this->Shape.rows(),
      [&level, flip, firstVertex, firstTriangle, ids, offsets](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType row = begin; row < end; ++row)
        {
          Index triangle = firstTriangle + level.firstTriangle(row);
          level.forEachTriangle(row,
            [flip, firstVertex, ids, offsets, &triangle](Index a, Index b, Index c)
            {
              offsets[triangle] = static_cast<Id>(3 * triangle);
              Id* corner = ids + 3 * triangle++;
              corner[0] = static_cast<Id>(firstVertex + a);
              corner[1] = static_cast<Id>(firstVertex + (flip ? c : b));
              corner[2] = static_cast<Id>(firstVertex + (flip ? b : c));
            });
        }
      });
  }

  vtkDataSet* Input;
  LatticeShape Shape;
  const Points& X;
  const T* Values;
  std::unique_ptr<LatticeBits> Usable; // points; null for all
  std::unique_ptr<LatticeBits> Cells;  // null for all
  std::vector<std::unique_ptr<ContourLevel>> Levels;
  std::vector<double> LevelValues;
  vtkIdType Vertices = 0;
  vtkIdType Triangles = 0;
};

/// What the two kinds of grid have in common when they are contoured.
struct Request
{
  vtkCloudContour* Filter;
  vtkDataSet* Input;
  vtkPolyData* Output;
  vtkDataArray* Field;
  const std::vector<double>& Values;
  bool Normals;

  bool Aborted(double progress) const
  {
    this->Filter->UpdateProgress(progress);
    return this->Filter->GetAbortExecute() != 0;
  }
};

template <class Points, class T>
void contourLattice(const Request& request, const Points& points, const T* values)
{
  const LatticeShape shape = nephoscope::latticeShape(request.Input);
  LatticeContour<Points, T> contour(request.Input, shape, points, values);
  contour.FindUsable();
  if (nephoscope::closesOnItself(shape, points) && contour.SeamValuesAgree())
  {
    if (shape.n[0] % 2 == 1)
    {
      contour.CloseSeam();
    }
    else
    {
      vtkWarningWithObjectMacro(request.Filter,
        "The grid closes on itself with an odd number of cells (" << shape.n[0] -
            1 << "), so the surface is open at the seam; an even number would close it.");
    }
  }
  for (double value : request.Values)
  {
    contour.Count(value);
  }
  if (request.Aborted(0.3))
  {
    return;
  }
  Output out;
  allocate(out, request.Input, request.Output, request.Field,
    std::is_same<typename Points::Real, double>::value, request.Normals,
    contour.GetNumberOfVertices(), contour.GetNumberOfTriangles());
  contour.Generate(out);
  attach(out, request.Output);
}

template <class T>
void contourLatticeOf(const Request& request, const T* values)
{
  if (auto* grid = vtkStructuredGrid::SafeDownCast(request.Input))
  {
    const std::array<int, 3> n = nephoscope::latticeShape(grid).n;
    vtkDataArray* data = grid->GetPoints()->GetData();
    if (auto* floats = vtkAOSDataArrayTemplate<float>::FastDownCast(data))
    {
      contourLattice(
        request, nephoscope::CurvilinearPoints<float>{ floats->GetPointer(0), n }, values);
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
      values);
  }
  else if (auto* rectilinear = vtkRectilinearGrid::SafeDownCast(request.Input))
  {
    contourLattice(request, nephoscope::productPoints(rectilinear), values);
  }
  else
  {
    contourLattice(
      request, nephoscope::productPoints(vtkImageData::SafeDownCast(request.Input)), values);
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
    if (grid->GetCellType(cell) != VTK_TETRA)
    {
      return false;
    }
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    grid->GetCellPoints(cell, count, ids);
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
void writeTetrahedraVertices(const Request& request, Output& out, const TetrahedraSurface& surface,
  double value, vtkIdType first, const T* values, const std::vector<Vector3>& gradients)
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
  Output out;
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
  attach(out, request.Output);
  return 1;
}

template <class T>
int contour(const Request& request, const T* values)
{
  if (request.Input->IsA("vtkUnstructuredGrid"))
  {
    return contourTetrahedra(request, values);
  }
  contourLatticeOf(request, values);
  return 1;
}
}

vtkCloudContour::vtkCloudContour()
  : Values(1, 0.15)
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

vtkDataArray* vtkCloudContour::FindField(vtkDataSet* input, vtkInformationVector** inputVector)
{
  int association = vtkDataObject::FIELD_ASSOCIATION_POINTS;
  vtkDataArray* field = this->GetInputArrayToProcess(0, inputVector, association);
  if (!field)
  {
    std::string names;
    for (int a = 0; a < input->GetPointData()->GetNumberOfArrays(); ++a)
    {
      const char* name = input->GetPointData()->GetArrayName(a);
      names += std::string(a > 0 ? ", " : "") + (name ? name : "(no name)");
    }
    const char* wanted = this->GetInputArrayInformation(0)->Get(vtkDataObject::FIELD_NAME());
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

  const Request request{ this, input, output, field, this->Values, this->ComputeNormals };
  if (auto* floats = vtkAOSDataArrayTemplate<float>::FastDownCast(field))
  {
    return contour(request, floats->GetPointer(0));
  }
  vtkSmartPointer<vtkDataArray> doubles = field;
  if (!vtkAOSDataArrayTemplate<double>::FastDownCast(field))
  {
    doubles = vtkSmartPointer<vtkDoubleArray>::New();
    doubles->DeepCopy(field);
  }
  return contour(request, vtkAOSDataArrayTemplate<double>::FastDownCast(doubles)->GetPointer(0));
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
