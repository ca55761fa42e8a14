// SPDX-License-Identifier: BSD-3-Clause
#include "TileExchange.h"

#include "PairedExchange.h"
#include "vtkMultiProcessController.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <numeric>

namespace
{
using Packet = TileExchange::Packet;

/// About 0.6 n, without a common divisor with n >= 1: its multiples modulo n are all numbers below n, spread out.
vtkIdType strideThrough(vtkIdType n)
{
  vtkIdType stride = 3 * n / 5 + 1;
  while (std::gcd(stride, n) > 1)
  {
    ++stride;
  }
  return stride;
}

/// Append the packet's length and the packet, which is emptied.
void append(Packet& message, Packet& packet)
{
  const std::uint64_t size = packet.size();
  const auto* const bytes = reinterpret_cast<const char*>(&size);
  message.insert(message.end(), bytes, bytes + sizeof size);
  message.insert(message.end(), packet.begin(), packet.end());
  packet = {};
}

/// Find the next packet of a message.
TileExchange::Received next(const Packet& message, std::size_t& at)
{
  std::uint64_t size = 0;
  std::memcpy(&size, message.data() + at, sizeof size);
  const TileExchange::Received packet{ message.data() + at + sizeof size, size };
  at += sizeof size + size;
  return packet;
}
}

TileExchange::TileExchange(
  vtkMultiProcessController* controller, vtkIdType tiles, vtkIdType tilesOfARank)
  : Controller(controller)
  , Ranks(controller->GetNumberOfProcesses())
  , Rank(controller->GetLocalProcessId())
  , Tiles(tiles)
  , Stride(strideThrough(tiles))
  , TilesOfARound(tilesOfARank * this->Ranks)
{
}

/// Rounds begin at multiples of the number of ranks: the n-th tile of a rank is n * Ranks + rank in the round.
void TileExchange::SetRound(vtkIdType firstTurn)
{
  this->First = firstTurn;
  this->Count = std::min(this->TilesOfARound, this->Tiles - firstTurn);
}

vtkIdType TileExchange::PlaceOf(int rank, vtkIdType n) const
{
  return n * this->Ranks + rank;
}

vtkIdType TileExchange::CountOf(int rank) const
{
  return std::max<vtkIdType>((this->Count - rank + this->Ranks - 1) / this->Ranks, 0);
}

void TileExchange::Exchange(std::vector<Packet>& outgoing)
{
  for (int rank = 0; rank < this->Ranks; ++rank)
  {
    this->BytesSent += rank == this->Rank ? 0 : static_cast<vtkIdType>(outgoing[rank].size());
  }
  this->Incoming = nephoscope::exchangeInPairs(*this->Controller, outgoing);
}

std::vector<std::vector<TileExchange::Received>> TileExchange::ToOwners(
  std::vector<Packet>& packets)
{
  std::vector<Packet> outgoing(static_cast<std::size_t>(this->Ranks));
  for (vtkIdType n = 0; n < this->Count; ++n)
  {
    append(outgoing[n % this->Ranks], packets[n]);
  }
  this->Exchange(outgoing);
  std::vector<std::vector<Received>> received(static_cast<std::size_t>(this->GetOwnCount()));
  for (const Packet& message : this->Incoming)
  {
    std::size_t at = 0;
    for (std::vector<Received>& tile : received)
    {
      tile.push_back(next(message, at));
    }
  }
  return received;
}

std::vector<TileExchange::Received> TileExchange::FromOwners(
  std::vector<std::vector<Packet>>& packets)
{
  std::vector<Packet> outgoing(static_cast<std::size_t>(this->Ranks));
  for (std::vector<Packet>& tile : packets)
  {
    for (int rank = 0; rank < this->Ranks; ++rank)
    {
      append(outgoing[rank], tile[rank]);
    }
  }
  this->Exchange(outgoing);
  std::vector<Received> received(static_cast<std::size_t>(this->Count));
  for (int rank = 0; rank < this->Ranks; ++rank)
  {
    std::size_t at = 0;
    for (vtkIdType n = 0; n < this->CountOf(rank); ++n)
    {
      received[this->PlaceOf(rank, n)] = next(this->Incoming[rank], at);
    }
  }
  return received;
}
