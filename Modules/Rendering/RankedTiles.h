// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file RankedTiles.h
 * @brief A picture by several processes, each with its pieces of the bodies: deep pixels are put together exactly.
 *
 * Tile t belongs to rank t modulo the number of ranks. In rounds of a few tiles a rank
 *  1. each rank puts the segments of its pieces into the deep tiles of the round, all of them, and packs them;
 *  2. each tile's packets go to the rank that it belongs to (RankExchange);
 *  3. that rank adds the bodies that are the same everywhere, composites, and sends the finished pixels to rank 0.
 * Segments are put together in the order of ranks and sorted by distance as those of one process are, so the picture is that of one
 * process but for the rounding of sums. Opaque bodies that are the same everywhere hide segments before they are packed.
 *
 * Memory: packets of one round.
 */
#ifndef RankedTiles_h
#define RankedTiles_h

#include "TileDrawer.h"

class vtkMultiProcessController;

/// Whether optical depths may be summed on each rank: one body of pieces is all that is not opaque, no opaque one is in pieces, and no
/// depth is wanted.
bool sumsMayBeSent(const TileScene& scene);

/**
 * Draw all tiles with all processes of the controller, which have to call it with the same scene but for the pieces.
 * @param scene of the bodies that draw pieces, those whose piece is not empty here; of the others all
 * @param picture of rank 0; null for the others
 * @param sums sumsMayBeSent of the scene with all bodies
 * @param[out] segments of all ranks
 * @return false if it was aborted somewhere
 */
bool drawRankedTiles(vtkCloudscape* scape, vtkMultiProcessController* controller,
  const TileScene& scene, bool sums, TilePicture* picture, vtkIdType& segments);
#endif
