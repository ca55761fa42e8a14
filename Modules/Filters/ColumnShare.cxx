// SPDX-License-Identifier: BSD-3-Clause
#include "ColumnShare.h"

#include "PairedExchange.h"
#include "vtkCommunicator.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace nephoscope
{
namespace
{
ColumnRectangle rectangleOf(const PointExtent& whole, const PointExtent& block)
{
  return { block[0] - whole[0], block[2] - whole[2], block[1] - block[0] + 1,
    block[3] - block[2] + 1 };
}

/// Of the columns on the far borders those that are the whole's last are the block's own.
ColumnRectangle withoutBorders(ColumnRectangle block, const int size[2])
{
  block.columns -= block.firstColumn + block.columns < size[0] ? 1 : 0;
  block.rows -= block.firstRow + block.rows < size[1] ? 1 : 0;
  return block;
}

float floatOfBits(std::uint32_t bits)
{
  float value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

using Packets = std::vector<std::vector<float>>;
}

ColumnShare::ColumnShare(int columns, int rows)
  : Size{ columns, rows }
  , Own{ 0, 0, columns, rows }
  , Block(Own)
{
}

ColumnShare::ColumnShare(vtkMultiProcessController* controller, const PointExtent& whole)
  : Size{ whole[1] - whole[0] + 1, whole[3] - whole[2] + 1 }
  , Controller(controller)
  , Owners(static_cast<std::size_t>(Size[0]) * Size[1])
{
  const int ranks = controller->GetNumberOfProcesses();
  for (int rank = 0; rank < ranks; ++rank)
  {
    PointExtent extent;
    if (!columnBlock(whole, rank, ranks, extent))
    {
      continue;
    }
    const ColumnRectangle block = rectangleOf(whole, extent);
    const ColumnRectangle own = withoutBorders(block, this->Size);
    for (std::size_t n = 0; n < own.size(); ++n)
    {
      this->Owners[own.column(n) + static_cast<std::size_t>(this->Size[0]) * own.row(n)] = rank;
    }
    if (rank == controller->GetLocalProcessId())
    {
      this->Block = block;
      this->Own = own;
    }
  }
}

bool everywhere(vtkMultiProcessController* controller, bool here)
{
  const int mine = here ? 1 : 0;
  int all = mine;
  if (controller)
  {
    controller->AllReduce(&mine, &all, 1, vtkCommunicator::MIN_OP);
  }
  return all != 0;
}

void require(vtkMultiProcessController* controller, const std::string& wrong)
{
  if (!everywhere(controller, wrong.empty()))
  {
    throw GridError(
      wrong.empty() ? "Another process cannot use its piece; see its message." : wrong);
  }
}

void ColumnShare::largest(double* values, std::size_t count) const
{
  if (this->Controller)
  {
    const std::vector<double> mine(values, values + count);
    this->Controller->AllReduce(
      mine.data(), values, static_cast<vtkIdType>(count), vtkCommunicator::MAX_OP);
  }
}

double ColumnShare::largest(const std::vector<float>& values, double least) const
{
  double most = least;
  for (const float value : values)
  {
    most = std::max(most, static_cast<double>(value));
  }
  this->largest(&most, 1);
  return most;
}

long long ColumnShare::sum(long long value) const
{
  long long all = value;
  if (this->Controller)
  {
    this->Controller->AllReduce(&value, &all, 1, vtkCommunicator::SUM_OP);
  }
  return all;
}

/// Of many processes by bisecting the bits of floats, which rise with the values: nobody needs to have them all.
float ColumnShare::ranked(std::vector<float> values, long long before) const
{
  if (!this->Controller)
  {
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(before);
    std::nth_element(values.begin(), at, values.end());
    return *at;
  }
  std::uint32_t least = 0;
  std::uint32_t most = 0x7f800000; // infinity
  while (least < most)
  {
    const std::uint32_t middle = least + (most - least) / 2;
    const float value = floatOfBits(middle);
    const auto here =
      std::count_if(values.begin(), values.end(), [value](float v) { return v <= value; });
    if (this->sum(here) > before)
    {
      most = middle;
    }
    else
    {
      least = middle + 1;
    }
  }
  return floatOfBits(least);
}

ColumnRequest::ColumnRequest(const ColumnShare& share, const std::vector<int>& columns)
  : Share(&share)
  , Count(columns.size())
  , From(static_cast<std::size_t>(share.controller()->GetNumberOfProcesses()))
{
  std::vector<std::vector<int>> wanted(this->From.size());
  for (std::size_t place = 0; place < columns.size(); ++place)
  {
    const int owner = share.ownerOf(columns[place]);
    wanted[owner].push_back(columns[place]);
    this->From[owner].push_back(static_cast<int>(place));
  }
  this->To = exchangeInPairs(*share.controller(), wanted);
  const ColumnRectangle& own = share.own();
  for (std::vector<int>& list : this->To)
  {
    for (int& column : list)
    {
      const int i = column % share.columns() - own.firstColumn;
      const int j = column / share.columns() - own.firstRow;
      column = i + own.columns * j;
    }
  }
}

std::vector<float> ColumnRequest::fetch(
  const std::vector<float>& own, int levels, int components) const
{
  Packets outgoing(this->To.size());
  for (std::size_t rank = 0; rank < outgoing.size(); ++rank)
  {
    outgoing[rank].reserve(this->To[rank].size() * levels * components);
    for (int k = 0; k < levels; ++k)
    {
      for (const int place : this->To[rank])
      {
        const auto value = own.begin() +
          static_cast<std::ptrdiff_t>((place + this->Share->own().size() * k) * components);
        outgoing[rank].insert(outgoing[rank].end(), value, value + components);
      }
    }
  }
  const Packets incoming = exchangeInPairs(*this->Share->controller(), outgoing);
  std::vector<float> values(this->Count * levels * components);
  for (std::size_t rank = 0; rank < incoming.size(); ++rank)
  {
    auto value = incoming[rank].begin();
    for (int k = 0; k < levels; ++k)
    {
      for (const int place : this->From[rank])
      {
        std::copy_n(value, components,
          values.begin() + static_cast<std::ptrdiff_t>((place + this->Count * k) * components));
        value += components;
      }
    }
  }
  return values;
}

Neighborhood::Neighborhood(
  const ColumnShare& share, const ColumnGrid& grid, double radius, double distance)
  : IsDivided(share.isDivided())
{
  if (!this->IsDivided)
  {
    return;
  }
  const std::vector<int> columns = columnsWithin(grid, share.own(), distance, radius);
  this->Count = columns.size();
  this->Places.assign(static_cast<std::size_t>(share.columns()) * share.rows(), -1);
  for (std::size_t place = 0; place < columns.size(); ++place)
  {
    this->Places[columns[place]] = static_cast<int>(place);
  }
  this->Request = ColumnRequest(share, columns);
}

HeldColumns Neighborhood::held() const
{
  return this->IsDivided ? HeldColumns{ this->Places.data(), this->Count } : HeldColumns{};
}

NearbyValues Neighborhood::gather(const std::vector<float>& own, int levels, int components) const
{
  NearbyValues values;
  if (this->IsDivided)
  {
    values.Copied = this->Request.fetch(own, levels, components);
  }
  else
  {
    values.Borrowed = own.data();
  }
  return values;
}
}
