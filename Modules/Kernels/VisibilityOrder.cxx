// SPDX-License-Identifier: BSD-3-Clause
#include "VisibilityOrder.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace nephoscope
{
namespace
{
/// The cells behind each, and how many before it are not taken yet.
class Graph
{
public:
  Graph(std::size_t cells, const std::vector<CellRelations>& lists)
    : Starts(cells + 1, 0)
    , Waiting(cells, 0)
  {
    forEach(lists,
      [this](const CellRelation& r)
      {
        ++this->Starts[r.before + 1];
        ++this->Waiting[r.after];
      });
    std::partial_sum(this->Starts.begin(), this->Starts.end(), this->Starts.begin());
    this->Behind.resize(this->Starts.back());
    forEach(
      lists, [this](const CellRelation& r) { this->Behind[this->Starts[r.before]++] = r.after; });
    std::copy_backward(this->Starts.begin(), this->Starts.end() - 1, this->Starts.end());
    this->Starts.front() = 0;
  }

  const std::uint32_t* begin(std::uint32_t cell) const
  {
    return this->Behind.data() + this->Starts[cell];
  }
  const std::uint32_t* end(std::uint32_t cell) const
  {
    return this->Behind.data() + this->Starts[cell + 1];
  }
  std::size_t size() const { return this->Waiting.size(); }
  std::uint32_t& waiting(std::uint32_t cell) { return this->Waiting[cell]; }

private:
  template <class Visit>
  static void forEach(const std::vector<CellRelations>& lists, Visit&& visit)
  {
    for (const CellRelations& list : lists)
    {
      for (const CellRelation& relation : list)
      {
        if (relation.before != relation.after)
        {
          visit(relation);
        }
      }
    }
  }

  std::vector<std::size_t> Starts;
  std::vector<std::uint32_t> Behind;
  std::vector<std::uint32_t> Waiting;
};

/// Strongly connected components of the cells that are not taken, by Tarjan's algorithm with a stack of its own.
class Components
{
public:
  static constexpr std::uint32_t None = std::numeric_limits<std::uint32_t>::max();

  Components(const Graph& graph, const std::vector<char>& taken)
    : G(graph)
    , Taken(taken)
    , Number(graph.size(), None)
    , Low(graph.size(), None)
    , Of(graph.size(), None)
  {
    for (std::uint32_t cell = 0; cell < graph.size(); ++cell)
    {
      if (!taken[cell] && this->Number[cell] == None)
      {
        this->search(cell);
      }
    }
  }

  /// A cell's component; if a relation leads from one to another, the other's number is less.
  std::uint32_t of(std::uint32_t cell) const { return this->Of[cell]; }
  std::size_t size(std::uint32_t component) const { return this->Sizes[component]; }
  const std::vector<std::size_t>& sizes() const { return this->Sizes; }

private:
  struct Step
  {
    std::uint32_t cell;
    const std::uint32_t* next;
  };

  void enter(std::uint32_t cell)
  {
    this->Number[cell] = this->Low[cell] = this->Count++;
    this->Open.push_back(cell);
    this->Path.push_back({ cell, this->G.begin(cell) });
  }

  void search(std::uint32_t root)
  {
    this->enter(root);
    while (!this->Path.empty())
    {
      Step& step = this->Path.back();
      if (step.next != this->G.end(step.cell))
      {
        const std::uint32_t behind = *step.next++;
        if (this->Taken[behind])
        {
          continue;
        }
        if (this->Number[behind] == None)
        {
          this->enter(behind);
        }
        else if (this->Of[behind] == None)
        {
          this->Low[step.cell] = std::min(this->Low[step.cell], this->Number[behind]);
        }
        continue;
      }
      const std::uint32_t cell = step.cell;
      this->Path.pop_back();
      if (!this->Path.empty())
      {
        std::uint32_t& low = this->Low[this->Path.back().cell];
        low = std::min(low, this->Low[cell]);
      }
      if (this->Low[cell] == this->Number[cell])
      {
        this->close(cell);
      }
    }
  }

  void close(std::uint32_t root)
  {
    const auto component = static_cast<std::uint32_t>(this->Sizes.size());
    this->Sizes.push_back(0);
    std::uint32_t cell = None;
    while (cell != root)
    {
      cell = this->Open.back();
      this->Open.pop_back();
      this->Of[cell] = component;
      ++this->Sizes.back();
    }
  }

  const Graph& G;
  const std::vector<char>& Taken;
  std::vector<std::uint32_t> Number;
  std::vector<std::uint32_t> Low;
  std::vector<std::uint32_t> Of;
  std::vector<std::size_t> Sizes;
  std::vector<std::uint32_t> Open;
  std::vector<Step> Path;
  std::uint32_t Count = 0;
};

/// Takes cells one by one; the order is its own queue.
class Taker
{
public:
  Taker(Graph& graph, std::vector<std::uint32_t>& order)
    : G(graph)
    , Order(order)
    , Taken(graph.size(), 0)
  {
    order.reserve(graph.size());
    for (std::uint32_t cell = 0; cell < graph.size(); ++cell)
    {
      if (graph.waiting(cell) == 0)
      {
        this->take(cell);
      }
    }
    this->follow();
  }

  const std::vector<char>& taken() const { return this->Taken; }

  void take(std::uint32_t cell)
  {
    this->Taken[cell] = 1;
    this->Order.push_back(cell);
  }

  /// Release what the taken cells were before, until none is free.
  void follow()
  {
    for (; this->Done < this->Order.size(); ++this->Done)
    {
      const std::uint32_t cell = this->Order[this->Done];
      for (const std::uint32_t* behind = this->G.begin(cell); behind != this->G.end(cell); ++behind)
      {
        if (--this->G.waiting(*behind) == 0 && !this->Taken[*behind])
        {
          this->take(*behind);
        }
      }
    }
  }

private:
  Graph& G;
  std::vector<std::uint32_t>& Order;
  std::vector<char> Taken;
  std::size_t Done = 0;
};

/// Cells in cycles, those of the foremost cycle first, in each by distance.
std::vector<std::uint32_t> cellsInCycles(
  const Components& components, const std::vector<char>& taken, const std::vector<double>& distance)
{
  std::vector<std::uint32_t> cells;
  for (std::uint32_t cell = 0; cell < taken.size(); ++cell)
  {
    if (!taken[cell] && components.size(components.of(cell)) > 1)
    {
      cells.push_back(cell);
    }
  }
  std::sort(cells.begin(), cells.end(),
    [&components, &distance](std::uint32_t a, std::uint32_t b)
    {
      const std::uint32_t ofA = components.of(a);
      const std::uint32_t ofB = components.of(b);
      return ofA != ofB              ? ofA > ofB
        : distance[a] != distance[b] ? distance[a] < distance[b]
                                     : a < b;
    });
  return cells;
}
}

VisibilityOrder visibilityOrder(std::size_t cells, const std::vector<CellRelations>& relations,
  const std::vector<double>& distance)
{
  VisibilityOrder result;
  Graph graph(cells, relations);
  Taker taker(graph, result.cells);
  if (result.cells.size() == cells)
  {
    return result;
  }
  const Components components(graph, taker.taken());
  for (const std::size_t size : components.sizes())
  {
    result.cycles += size > 1 ? 1 : 0;
    result.cellsInCycles += size > 1 ? size : 0;
  }
  for (const std::uint32_t cell : cellsInCycles(components, taker.taken(), distance))
  {
    if (!taker.taken()[cell])
    {
      taker.take(cell);
      taker.follow();
    }
  }
  return result;
}

std::vector<std::uint32_t> distanceOrder(const std::vector<double>& distance)
{
  std::vector<std::uint32_t> order(distance.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
    [&distance](std::uint32_t a, std::uint32_t b)
    { return distance[a] != distance[b] ? distance[a] < distance[b] : a < b; });
  return order;
}
}
