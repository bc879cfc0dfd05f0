// What the readers of both formats make of intensities and angles that are not quite as they should be.
#pragma once
#include "photometry/number_reader.h"
#include "photometry/photometry.h"

namespace lw {

/// Adds "NAME: what" to what the user is told of the file.
void note(const NumberReader& reader, Photometry& photometry, const std::string& what);

/// Takes negative intensities that are noise of a measurement (at most 0.1 % of the strongest, or 0.01) as 0 and notes
/// it. Throws Error for larger ones, with their angles.
void settle_negative_intensities(const NumberReader& reader, Photometry& photometry);

/// Notes angles in front of the luminaire for which the file has no intensity: they get 0.
void note_missing_angles(const NumberReader& reader, Photometry& photometry);

/// Closes a ring of planes that ends a step before its start, as C 0 to 345 does: the first plane comes once more.
void close_ring(Photometry& photometry);

/// Notes what follows the last number that was read, if anything does.
void note_left_over(NumberReader& reader, Photometry& photometry);

}  // namespace lw
