// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file TileExchange.h
 * @brief Packets about the tiles of a picture, from all processes to the tile's owner and back.
 *
 * Tiles take turns: the next is some three fifths of the picture further on, so that those of a round are spread over all of it, and ranks
 * have about as much to do. Turn t belongs to rank t modulo the number of ranks. Rounds are of as many tiles for each rank; a packet is
 * bytes that only who writes and who reads them understand, and may be empty.
 */
#ifndef TileExchange_h
#define TileExchange_h

#include "vtkType.h"

#include <cstddef>
#include <vector>

class vtkMultiProcessController;

class TileExchange
{
public:
  using Packet = std::vector<char>;
  /// A packet that came, valid until the next exchange.
  struct Received
  {
    const char* Data = nullptr;
    std::size_t Size = 0;
  };

  TileExchange(vtkMultiProcessController* controller, vtkIdType tiles, vtkIdType tilesOfARank);

  int GetRanks() const { return this->Ranks; }
  vtkIdType GetTilesOfARound() const { return this->TilesOfARound; }
  void SetRound(vtkIdType firstTurn);
  vtkIdType GetTileOfTurn(vtkIdType turn) const { return turn * this->Stride % this->Tiles; }

  /// Tiles of the round: the n-th is GetTile(n); the n-th that is this rank's is GetOwnTile(n).
  vtkIdType GetCount() const { return this->Count; }
  vtkIdType GetTile(vtkIdType n) const { return this->GetTileOfTurn(this->First + n); }
  vtkIdType GetOwnCount() const { return this->CountOf(this->Rank); }
  vtkIdType GetOwnTile(vtkIdType n) const { return this->GetTile(this->PlaceOf(this->Rank, n)); }

  ///@{
  /// All ranks have to call them in the same order; packets are emptied as they go.
  /// @param packets one for each tile of the round @return for each own tile what came from each rank
  std::vector<std::vector<Received>> ToOwners(std::vector<Packet>& packets);
  /// @param packets for each own tile one to each rank @return what came for each tile of the round
  std::vector<Received> FromOwners(std::vector<std::vector<Packet>>& packets);
  ///@}

  /// Of packets to other ranks, in all rounds.
  vtkIdType GetBytesSent() const { return this->BytesSent; }

private:
  vtkIdType CountOf(int rank) const;
  vtkIdType PlaceOf(int rank, vtkIdType n) const; ///< in the round
  void Exchange(std::vector<Packet>& outgoing);

  vtkMultiProcessController* Controller;
  int Ranks;
  int Rank;
  vtkIdType Tiles;
  vtkIdType Stride; ///< has no divisor in common with Tiles
  vtkIdType TilesOfARound;
  vtkIdType First = 0;
  vtkIdType Count = 0;
  vtkIdType BytesSent = 0;
  std::vector<Packet> Incoming; ///< from each rank
};
#endif
