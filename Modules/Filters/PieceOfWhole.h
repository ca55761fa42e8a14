// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file PieceOfWhole.h
 * @brief Pieces from filters that need the whole grid: they ask for all of it, and give the block that was asked of them.
 */
#ifndef PieceOfWhole_h
#define PieceOfWhole_h

class vtkDataSet;
class vtkInformation;

namespace nephoscope
{
/// Ask an input for its whole extent in one piece, whatever the output's piece is.
void askForWhole(vtkInformation* input);

/**
 * @brief Ask an input for the output's piece, with other levels of ghosts; for its whole extent if it gives no pieces.
 * @return whether it gives pieces
 */
bool askForPiece(vtkInformation* input, vtkInformation* output, int ghosts);

/**
 * @brief Cut a structured output down to the piece that its information asks for, if that is one of several.
 *
 * The piece is a nephoscope::columnBlock with its ghosts marked; of a vtkStructuredGrid that closes on itself they go on across the
 * seam. More pieces than columns: the last ones are empty.
 */
void cutPiece(vtkDataSet* output, vtkInformation* information);
}
#endif
