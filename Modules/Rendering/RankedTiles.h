// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file RankedTiles.h
 * @brief A picture by several processes, each with its pieces of the bodies: deep pixels are put together exactly.
 *
 * Tile t belongs to rank t modulo the number of ranks (TileExchange). In rounds of a few tiles a rank
 *  1. each rank puts the segments of its pieces into the deep tiles of the round, all of them, composites each pixel and tells the tile's
 *     owner what they amount to between which distances (DeepTile::runs);
 *  2. the owner composites the pixels in which these runs follow one another, with the bodies that are the same everywhere, and asks for
 *     all segments of the others, and for a depth within a run where it cannot know it (PixelRuns);
 *  3. the ranks answer from the deep tiles that they have kept, and the owner completes its pixels.
 * In the end the finished pixels go to rank 0. Where all segments of most runs of a round are asked for, as in a medium that all
 * processes have, the next rounds send all segments at once; sums of optical depths (sumsMayBeSent) are sent in place of runs.
 *
 * Segments of a pixel are put together in the order of ranks and sorted by distance as those of one process are, so the picture is that of
 * one process but for the rounding of sums. Opaque bodies that are the same everywhere hide segments before they are composited.
 *
 * Memory: this rank's segments in the tiles of a round, twice, or once and their runs; of the tiles that it owns in the round what the
 * others send, runs, then the segments that were asked for, or all segments; and 28 bytes for each pixel of all tiles that it owns.
 */
#ifndef RankedTiles_h
#define RankedTiles_h

#include "TileDrawer.h"

class vtkMultiProcessController;

/// Whether optical depths may be summed on each rank: one body of pieces is all that is not opaque, no opaque one is in pieces, and no
/// depth is wanted.
bool sumsMayBeSent(const TileScene& scene);

/// Of all ranks together.
struct RankedFigures
{
  vtkIdType Segments = 0;  ///< of pieces
  vtkIdType BytesSent = 0; ///< to other ranks, without finished pixels
};

/**
 * Draw all tiles with all processes of the controller, which have to call it with the same scene but for the pieces.
 * @param scene of the bodies that draw pieces, those whose piece is not empty here; of the others all
 * @param picture of rank 0; null for the others
 * @param sums sumsMayBeSent of the scene with all bodies
 * @return false if it was aborted somewhere
 */
bool drawRankedTiles(vtkCloudscape* scape, vtkMultiProcessController* controller,
  const TileScene& scene, bool sums, TilePicture* picture, RankedFigures& figures);
#endif
