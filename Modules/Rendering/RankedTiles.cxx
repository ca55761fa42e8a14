// SPDX-License-Identifier: BSD-3-Clause
#include "RankedTiles.h"

#include "RankExchange.h"
#include "vtkCloudBody.h"
#include "vtkCloudscape.h"
#include "vtkCommunicator.h"
#include "vtkMultiProcessController.h"
#include "vtkSMPThreadLocal.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <atomic>
#include <cstring>

namespace
{
constexpr vtkIdType TilesOfARank = 8; // in a round

using Packet = std::vector<char>;

/// Append the packet's length and the packet.
void append(Packet& message, const Packet& packet)
{
  const std::uint64_t size = packet.size();
  const auto* const bytes = reinterpret_cast<const char*>(&size);
  message.insert(message.end(), bytes, bytes + sizeof size);
  message.insert(message.end(), packet.begin(), packet.end());
}

/// Take the next packet off a message.
Packet next(const Packet& message, std::size_t& at)
{
  std::uint64_t size = 0;
  std::memcpy(&size, message.data() + at, sizeof size);
  const auto first = message.begin() + static_cast<std::ptrdiff_t>(at + sizeof size);
  at += sizeof size + size;
  return { first, first + static_cast<std::ptrdiff_t>(size) };
}

class Round
{
public:
  Round(vtkMultiProcessController* controller, const TileScene& scene, bool sums)
    : Controller(controller)
    , Scene(scene)
    , Sums(sums)
    , Drawer(scene)
    , Ranks(controller->GetNumberOfProcesses())
    , Rank(controller->GetLocalProcessId())
  {
  }

  vtkIdType GetTilesOfARound() const { return TilesOfARank * this->Ranks; }
  vtkIdType GetNumberOfTiles() const { return this->Drawer.GetNumberOfTiles(); }
  vtkIdType GetNumberOfSegments() const { return this->Segments; }

  void Draw(vtkIdType first, TilePicture* picture)
  {
    this->First = first;
    this->Count = std::min(this->GetTilesOfARound(), this->GetNumberOfTiles() - first);
    std::vector<Packet> outgoing = this->PackAll();
    const std::vector<Packet> incoming = exchange(this->Controller, outgoing);
    this->Unpack(incoming);
    Packet finished = this->FinishAll();
    this->Gather(finished, picture);
  }

private:
  /// Tiles of the round that belong to a rank: the n-th is First + start + n * Ranks.
  vtkIdType Start(int rank) const
  {
    return (rank - this->First % this->Ranks + this->Ranks) % this->Ranks;
  }
  vtkIdType CountOf(int rank) const
  {
    return std::max<vtkIdType>(
      (this->Count - this->Start(rank) + this->Ranks - 1) / this->Ranks, 0);
  }
  vtkIdType TileOf(int rank, vtkIdType n) const
  {
    return this->First + this->Start(rank) + n * this->Ranks;
  }

  void Emit(nephoscope::DeepTile& tile, bool pieces, bool opaque) const
  {
    for (const vtkCloudBody* body : this->Scene.Bodies)
    {
      if (body->DrawsPieces() == pieces && body->IsOpaque() == opaque)
      {
        body->Emit(this->Scene.Camera, tile);
      }
    }
  }

  /// This rank's segments of a tile.
  void Pack(vtkIdType tile, TileWork& work, Packet& packet)
  {
    this->Drawer.Start(tile, work);
    this->Emit(work.Tile, false, true);
    work.Tile.keepLimitsOnly();
    this->Emit(work.Tile, true, true);
    if (this->Sums)
    {
      work.Tile.setLast();
    }
    this->Emit(work.Tile, true, false);
    this->Segments += static_cast<vtkIdType>(work.Tile.numberOfSegments());
    work.Tile.pack(packet);
  }

  /// For each rank the packets of its tiles.
  std::vector<Packet> PackAll()
  {
    std::vector<Packet> packets(static_cast<std::size_t>(this->Count));
    vtkSMPTools::For(0, this->Count, 1,
      [this, &packets](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType n = begin; n < end; ++n)
        {
          this->Pack(this->First + n, this->Works.Local(), packets[n]);
        }
      });
    std::vector<Packet> outgoing(static_cast<std::size_t>(this->Ranks));
    for (int rank = 0; rank < this->Ranks; ++rank)
    {
      for (vtkIdType n = this->Start(rank); n < this->Count; n += this->Ranks)
      {
        append(outgoing[rank], packets[n]);
        packets[n] = {};
      }
    }
    return outgoing;
  }

  /// The packets of this rank's tiles, those of a tile in the order of ranks.
  void Unpack(const std::vector<Packet>& incoming)
  {
    this->Packets.assign(static_cast<std::size_t>(this->CountOf(this->Rank)), {});
    for (const Packet& message : incoming)
    {
      std::size_t at = 0;
      for (std::vector<Packet>& tile : this->Packets)
      {
        tile.push_back(next(message, at));
      }
    }
  }

  /// The pixels of this rank's tiles, one tile after the other.
  Packet FinishAll()
  {
    std::vector<std::vector<float>> pixels(this->Packets.size());
    vtkSMPTools::For(0, static_cast<vtkIdType>(this->Packets.size()), 1,
      [this, &pixels](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType n = begin; n < end; ++n)
        {
          this->Finish(n, this->Works.Local());
          pixels[n] = this->Works.Local().Pixels;
        }
      });
    Packet all;
    for (const std::vector<float>& values : pixels)
    {
      const auto* const bytes = reinterpret_cast<const char*>(values.data());
      all.insert(all.end(), bytes, bytes + values.size() * sizeof(float));
    }
    return all;
  }

  void Finish(vtkIdType n, TileWork& work)
  {
    const vtkIdType tile = this->TileOf(this->Rank, n);
    this->Drawer.Start(tile, work);
    this->Emit(work.Tile, false, true);
    for (Packet& packet : this->Packets[n])
    {
      work.Tile.addPacked(packet);
      packet = {};
    }
    this->Emit(work.Tile, false, false);
    this->Drawer.Finish(tile, work);
  }

  /// Finished pixels go to rank 0.
  void Gather(Packet& finished, TilePicture* picture)
  {
    std::vector<Packet> outgoing(static_cast<std::size_t>(this->Ranks));
    outgoing[0].swap(finished);
    const std::vector<Packet> incoming = exchange(this->Controller, outgoing);
    for (int rank = 0; picture && rank < this->Ranks; ++rank)
    {
      std::size_t at = 0;
      for (vtkIdType n = 0; n < this->CountOf(rank); ++n)
      {
        const nephoscope::TileExtent tile = this->Drawer.GetPixels(this->TileOf(rank, n));
        std::vector<float> pixels(
          static_cast<std::size_t>(TileDrawer::ValuesOfPixel) * tile.width * tile.height);
        std::memcpy(pixels.data(), incoming[rank].data() + at, pixels.size() * sizeof(float));
        at += pixels.size() * sizeof(float);
        picture->Place(tile, pixels.data());
      }
    }
  }

  vtkMultiProcessController* Controller;
  const TileScene& Scene;
  bool Sums;
  TileDrawer Drawer;
  int Ranks;
  int Rank;
  vtkIdType First = 0;
  vtkIdType Count = 0;
  std::vector<std::vector<Packet>> Packets; ///< of each of this rank's tiles, from each rank
  std::atomic<vtkIdType> Segments{ 0 };
  vtkSMPThreadLocal<TileWork> Works;
};
}

bool sumsMayBeSent(const TileScene& scene)
{
  const auto& bodies = scene.Bodies;
  const auto pieces = std::count_if(
    bodies.begin(), bodies.end(), [](const vtkCloudBody* body) { return body->DrawsPieces(); });
  const auto translucent = std::count_if(
    bodies.begin(), bodies.end(), [](const vtkCloudBody* body) { return !body->IsOpaque(); });
  return !scene.DepthWanted && pieces == 1 && translucent == 1 &&
    std::any_of(bodies.begin(), bodies.end(),
      [](const vtkCloudBody* body) { return body->DrawsPieces() && !body->IsOpaque(); });
}

bool drawRankedTiles(vtkCloudscape* scape, vtkMultiProcessController* controller,
  const TileScene& scene, bool sums, TilePicture* picture, vtkIdType& segments)
{
  Round round(controller, scene, sums);
  for (vtkIdType first = 0; first < round.GetNumberOfTiles(); first += round.GetTilesOfARound())
  {
    const int aborted = scape->GetAbortExecute() ? 1 : 0;
    int abortedSomewhere = 0;
    controller->AllReduce(&aborted, &abortedSomewhere, 1, vtkCommunicator::MAX_OP);
    if (abortedSomewhere)
    {
      return false;
    }
    round.Draw(first, picture);
    scape->UpdateProgress(std::min(
      1.0, static_cast<double>(first + round.GetTilesOfARound()) / round.GetNumberOfTiles()));
  }
  const vtkIdType own = round.GetNumberOfSegments();
  controller->AllReduce(&own, &segments, 1, vtkCommunicator::SUM_OP);
  return true;
}
