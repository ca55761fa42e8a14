// SPDX-License-Identifier: BSD-3-Clause
#include "RankedTiles.h"

#include "PairedExchange.h"
#include "PixelRuns.h"
#include "TileExchange.h"
#include "vtkCloudBody.h"
#include "vtkCloudscape.h"
#include "vtkCommunicator.h"
#include "vtkMultiProcessController.h"
#include "vtkSMPThreadLocal.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>

namespace
{
using nephoscope::DeepTile;
using nephoscope::PixelLight;
using nephoscope::PixelRequest;
using nephoscope::PixelRun;
using nephoscope::PixelRuns;
using Packet = TileExchange::Packet;
using Received = TileExchange::Received;

/// In a round: so many that what ranks have to do in it evens out, so few that their segments find room.
vtkIdType tilesOfARank(vtkMultiProcessController* controller)
{
  return std::max(16, 64 / controller->GetNumberOfProcesses());
}

template <class T>
Packet packetOf(const std::vector<T>& items)
{
  const auto* const bytes = reinterpret_cast<const char*>(items.data());
  return { bytes, bytes + items.size() * sizeof(T) };
}

template <class T>
std::vector<T> itemsOf(const Received& packet)
{
  std::vector<T> items(packet.Size / sizeof(T));
  if (!items.empty())
  {
    std::memcpy(items.data(), packet.Data, items.size() * sizeof(T));
  }
  return items;
}

/// A rank's work with one tile.
struct RankWork : TileWork
{
  std::vector<PixelRun> Runs;
  PixelRuns Merger;
};

/// A tile that is this rank's to finish.
struct OwnTile
{
  std::vector<PixelLight> Light;
  Packet Opaque;                                   ///< of bodies that are the same everywhere
  Packet Translucent;                              ///< the same
  std::vector<std::vector<PixelRequest>> Requests; ///< to each rank, to Opaque, to Translucent
};

Received spanOf(const Packet& packet)
{
  return { packet.data(), packet.size() };
}

/// An answer from what was packed; the tile is empty.
Packet answerOf(const Packet& segments, const std::vector<PixelRequest>& requests, DeepTile& tile)
{
  std::vector<double> depths;
  Packet packed;
  tile.answer(segments.data(), segments.size(), requests, depths, packed);
  Packet answer = packetOf(depths);
  answer.insert(answer.end(), packed.begin(), packed.end());
  return answer;
}

/// Put the depths that were asked for into their pixels, the segments into a tile.
void takeAnswer(const std::vector<PixelRequest>& requests, const Received& answer,
  std::vector<PixelLight>& light, DeepTile& tile)
{
  const char* next = answer.Data;
  for (const PixelRequest& request : requests)
  {
    if (request.whole == 0)
    {
      double depth = 0;
      std::memcpy(&depth, next, sizeof depth);
      next += sizeof depth;
      light[request.pixel].depth = std::isfinite(depth) ? depth : light[request.pixel].depth;
    }
  }
  tile.addPacked(next, static_cast<std::size_t>(answer.Data + answer.Size - next));
}

class RankedPicture
{
public:
  RankedPicture(vtkMultiProcessController* controller, const TileScene& scene, bool sums)
    : Controller(controller)
    , Scene(scene)
    , Sums(sums)
    , Drawer(scene)
    , Tiles(controller, this->Drawer.GetNumberOfTiles(), tilesOfARank(controller))
    , Whole(sums)
  {
  }

  vtkIdType GetTilesOfARound() const { return this->Tiles.GetTilesOfARound(); }
  vtkIdType GetNumberOfTiles() const { return this->Drawer.GetNumberOfTiles(); }
  RankedFigures GetFigures() const;
  bool StartRound(vtkIdType first, bool abort);
  void DrawRound();
  void Gather(TilePicture* picture);

private:
  template <class Work>
  void ForEach(vtkIdType count, Work&& work)
  {
    vtkSMPTools::For(0, count, 1,
      [this, &work](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType n = begin; n < end; ++n)
        {
          work(n, this->Works.Local());
        }
      });
  }

  void Emit(DeepTile& tile, bool pieces, bool opaque) const;
  void DrawPieces(vtkIdType tile, TileWork& work);
  std::vector<Packet> DrawAndPack();
  std::vector<Packet> DrawRuns();
  void Keep(vtkIdType n, RankWork& work, Packet& packet);
  std::vector<Packet> Answer(const std::vector<Received>& requests);
  void Merge(vtkIdType n, RankWork& work, const std::vector<Received>& runs);
  void AddRuns(std::uint32_t part, RankWork& work);
  Packet DrawShared(bool opaque, std::uint32_t part, RankWork& work);
  Packet AnswerShared(vtkIdType tile, const Packet& segments,
    const std::vector<PixelRequest>& requests, RankWork& work) const;
  std::vector<std::vector<Packet>> PackRequests() const;
  void Complete(vtkIdType n, RankWork& work, const std::vector<Received>& answers);
  void FinishWhole(vtkIdType n, TileWork& work, const std::vector<Received>& packets);

  vtkMultiProcessController* Controller;
  const TileScene& Scene;
  bool Sums;
  TileDrawer Drawer;
  TileExchange Tiles;
  bool Whole;               ///< whether all segments are sent, or sums, not runs
  std::vector<Packet> Kept; ///< this rank's segments in each tile of the round
  std::vector<OwnTile> Own;
  std::vector<std::vector<float>> Finished; ///< this rank's pixels, tile by tile
  std::atomic<vtkIdType> Segments{ 0 };
  std::atomic<vtkIdType> Runs{ 0 };        ///< that came in the last round
  std::atomic<vtkIdType> Overlapping{ 0 }; ///< runs of them for which all segments were asked
  vtkSMPThreadLocal<RankWork> Works;
};

/// False if it was aborted somewhere. Most runs overlap where a medium is everywhere: then all segments are sent at once.
bool RankedPicture::StartRound(vtkIdType first, bool abort)
{
  const vtkIdType own[3] = { abort ? 1 : 0, this->Runs, this->Overlapping };
  vtkIdType all[3];
  this->Controller->AllReduce(own, all, 3, vtkCommunicator::SUM_OP);
  this->Whole = this->Whole || 2 * all[2] > all[1];
  if (this->Whole)
  {
    this->Kept = {};
    this->Own = {};
  }
  this->Runs = 0;
  this->Overlapping = 0;
  this->Tiles.SetRound(first);
  return all[0] == 0;
}

void RankedPicture::DrawRound()
{
  const auto finished = static_cast<vtkIdType>(this->Finished.size());
  this->Finished.resize(static_cast<std::size_t>(finished + this->Tiles.GetOwnCount()));
  const auto place = [this, finished](vtkIdType n, TileWork& work)
  { this->Finished[finished + n] = work.Pixels; };
  if (this->Whole)
  {
    std::vector<Packet> packets = this->DrawAndPack();
    const auto received = this->Tiles.ToOwners(packets);
    this->ForEach(this->Tiles.GetOwnCount(),
      [this, &received, &place](vtkIdType n, RankWork& work)
      {
        this->FinishWhole(n, work, received[n]);
        place(n, work);
      });
    return;
  }
  std::vector<Packet> runs = this->DrawRuns();
  const auto received = this->Tiles.ToOwners(runs);
  this->Own.resize(static_cast<std::size_t>(this->Tiles.GetOwnCount()));
  this->ForEach(this->Tiles.GetOwnCount(),
    [this, &received](vtkIdType n, RankWork& work) { this->Merge(n, work, received[n]); });
  std::vector<std::vector<Packet>> requests = this->PackRequests();
  std::vector<Packet> replies = this->Answer(this->Tiles.FromOwners(requests));
  const auto answers = this->Tiles.ToOwners(replies);
  this->ForEach(this->Tiles.GetOwnCount(),
    [this, &answers, &place](vtkIdType n, RankWork& work)
    {
      this->Complete(n, work, answers[n]);
      place(n, work);
    });
}

void RankedPicture::Emit(DeepTile& tile, bool pieces, bool opaque) const
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
void RankedPicture::DrawPieces(vtkIdType tile, TileWork& work)
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
}

std::vector<Packet> RankedPicture::DrawAndPack()
{
  std::vector<Packet> packets(static_cast<std::size_t>(this->Tiles.GetCount()));
  this->ForEach(this->Tiles.GetCount(),
    [this, &packets](vtkIdType n, RankWork& work)
    {
      this->DrawPieces(this->Tiles.GetTile(n), work);
      work.Tile.pack(packets[n]);
    });
  return packets;
}

std::vector<Packet> RankedPicture::DrawRuns()
{
  std::vector<Packet> packets(static_cast<std::size_t>(this->Tiles.GetCount()));
  this->Kept.resize(std::max(this->Kept.size(), packets.size()));
  this->ForEach(this->Tiles.GetCount(),
    [this, &packets](vtkIdType n, RankWork& work)
    {
      this->DrawPieces(this->Tiles.GetTile(n), work);
      this->Keep(n, work, packets[n]);
    });
  return packets;
}

/// Make runs of a tile's segments and keep them.
void RankedPicture::Keep(vtkIdType n, RankWork& work, Packet& packet)
{
  this->Kept[n].clear();
  if (work.Tile.numberOfSegments() > 0)
  {
    work.Runs.clear();
    work.Tile.runs(work.Runs);
    packet = packetOf(work.Runs);
    work.Tile.pack(this->Kept[n]);
  }
}

std::vector<Packet> RankedPicture::Answer(const std::vector<Received>& requests)
{
  std::vector<Packet> packets(requests.size());
  this->ForEach(static_cast<vtkIdType>(requests.size()),
    [this, &requests, &packets](vtkIdType n, RankWork& work)
    {
      if (requests[n].Size > 0)
      {
        this->Drawer.Start(this->Tiles.GetTile(n), work);
        packets[n] = answerOf(this->Kept[n], itemsOf<PixelRequest>(requests[n]), work.Tile);
      }
    });
  return packets;
}

/// The runs of a tile of this rank, its own and the others', and what has to be asked about them.
void RankedPicture::Merge(vtkIdType n, RankWork& work, const std::vector<Received>& runs)
{
  OwnTile& own = this->Own[n];
  this->Drawer.Start(this->Tiles.GetOwnTile(n), work);
  const nephoscope::TileExtent& extent = work.Tile.extent();
  work.Merger.reset(static_cast<std::size_t>(extent.width) * extent.height);
  const auto ranks = static_cast<std::uint32_t>(runs.size());
  own.Opaque = this->DrawShared(true, ranks, work);
  for (std::uint32_t part = 0; part < ranks; ++part)
  {
    work.Runs = itemsOf<PixelRun>(runs[part]);
    this->AddRuns(part, work);
    this->Runs += static_cast<vtkIdType>(work.Runs.size());
  }
  own.Translucent = this->DrawShared(false, ranks + 1, work);
  own.Requests.assign(runs.size() + 2, {});
  work.Merger.merge(this->Scene.DepthWanted, own.Light, own.Requests);
  for (std::size_t rank = 0; rank < runs.size(); ++rank)
  {
    this->Overlapping += std::count_if(own.Requests[rank].begin(), own.Requests[rank].end(),
      [](const PixelRequest& request) { return request.whole != 0; });
  }
}

void RankedPicture::AddRuns(std::uint32_t part, RankWork& work)
{
  for (PixelRun& run : work.Runs)
  {
    run.part = part;
    work.Merger.add(run);
  }
}

/// The segments of bodies that are the same everywhere, a part of their own. Only the limits of what is opaque stay in the work's tile.
Packet RankedPicture::DrawShared(bool opaque, std::uint32_t part, RankWork& work)
{
  this->Emit(work.Tile, false, opaque);
  work.Runs.clear();
  work.Tile.runs(work.Runs);
  this->AddRuns(part, work);
  Packet segments;
  work.Tile.pack(segments);
  work.Tile.keepLimitsOnly();
  return segments;
}

std::vector<std::vector<Packet>> RankedPicture::PackRequests() const
{
  std::vector<std::vector<Packet>> packets;
  for (const OwnTile& own : this->Own)
  {
    packets.emplace_back();
    for (int rank = 0; rank < this->Tiles.GetRanks(); ++rank)
    {
      packets.back().push_back(packetOf(own.Requests[rank]));
    }
  }
  return packets;
}

/// With the answers: depths, and pixels whose segments have to be mixed.
void RankedPicture::Complete(vtkIdType n, RankWork& work, const std::vector<Received>& answers)
{
  OwnTile& own = this->Own[n];
  const vtkIdType tile = this->Tiles.GetOwnTile(n);
  const std::size_t ranks = answers.size();
  const Packet opaque = this->AnswerShared(tile, own.Opaque, own.Requests[ranks], work);
  const Packet translucent =
    this->AnswerShared(tile, own.Translucent, own.Requests[ranks + 1], work);
  this->Drawer.Start(tile, work);
  takeAnswer(own.Requests[ranks], spanOf(opaque), own.Light, work.Tile);
  for (std::size_t rank = 0; rank < ranks; ++rank)
  {
    takeAnswer(own.Requests[rank], answers[rank], own.Light, work.Tile);
  }
  takeAnswer(own.Requests[ranks + 1], spanOf(translucent), own.Light, work.Tile);
  if (work.Tile.numberOfSegments() > 0)
  {
    work.Tile.composite(work.Light);
    for (const std::vector<PixelRequest>& requests : own.Requests)
    {
      for (const PixelRequest& request : requests)
      {
        own.Light[request.pixel] =
          request.whole != 0 ? work.Light[request.pixel] : own.Light[request.pixel];
      }
    }
  }
  work.Light.swap(own.Light);
  this->Drawer.Write(tile, work);
}

Packet RankedPicture::AnswerShared(vtkIdType tile, const Packet& segments,
  const std::vector<PixelRequest>& requests, RankWork& work) const
{
  if (requests.empty())
  {
    return {};
  }
  this->Drawer.Start(tile, work);
  return answerOf(segments, requests, work.Tile);
}

void RankedPicture::FinishWhole(vtkIdType n, TileWork& work, const std::vector<Received>& packets)
{
  const vtkIdType tile = this->Tiles.GetOwnTile(n);
  this->Drawer.Start(tile, work);
  this->Emit(work.Tile, false, true);
  for (const Received& packet : packets)
  {
    work.Tile.addPacked(packet.Data, packet.Size);
  }
  this->Emit(work.Tile, false, false);
  this->Drawer.Finish(tile, work);
}

/// Finished pixels go to rank 0, tile by tile.
void RankedPicture::Gather(TilePicture* picture)
{
  const int ranks = this->Controller->GetNumberOfProcesses();
  const int rank = this->Controller->GetLocalProcessId();
  for (vtkIdType turn = rank; !picture && turn < this->GetNumberOfTiles(); turn += ranks)
  {
    const std::vector<float>& pixels = this->Finished[turn / ranks];
    this->Controller->Send(
      pixels.data(), static_cast<vtkIdType>(pixels.size()), 0, nephoscope::ExchangeTag);
  }
  std::vector<float> received;
  for (vtkIdType turn = 0; picture && turn < this->GetNumberOfTiles(); ++turn)
  {
    const nephoscope::TileExtent extent = this->Drawer.GetPixels(this->Tiles.GetTileOfTurn(turn));
    const auto owner = static_cast<int>(turn % ranks);
    if (owner != rank)
    {
      received.resize(
        static_cast<std::size_t>(TileDrawer::ValuesOfPixel) * extent.width * extent.height);
      this->Controller->Receive(
        received.data(), static_cast<vtkIdType>(received.size()), owner, nephoscope::ExchangeTag);
    }
    picture->Place(extent, owner == rank ? this->Finished[turn / ranks].data() : received.data());
  }
}

RankedFigures RankedPicture::GetFigures() const
{
  const vtkIdType own[2] = { this->Segments, this->Tiles.GetBytesSent() };
  vtkIdType all[2];
  this->Controller->AllReduce(own, all, 2, vtkCommunicator::SUM_OP);
  return { all[0], all[1] };
}
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
  const TileScene& scene, bool sums, TilePicture* picture, RankedFigures& figures)
{
  RankedPicture ranked(controller, scene, sums);
  const vtkIdType tiles = ranked.GetNumberOfTiles();
  for (vtkIdType first = 0; first < tiles; first += ranked.GetTilesOfARound())
  {
    if (!ranked.StartRound(first, scape->GetAbortExecute() != 0))
    {
      return false;
    }
    ranked.DrawRound();
    scape->UpdateProgress(
      std::min(1.0, static_cast<double>(first + ranked.GetTilesOfARound()) / tiles));
  }
  ranked.Gather(picture);
  figures = ranked.GetFigures();
  return true;
}
