#ifndef rhombicLabelParts_h
#define rhombicLabelParts_h

#include "rhombicComparedSide.h"

#include <string>
#include <vector>

namespace rhombic
{

/** Divides labels of two label maps into their parts: voxels that touch by a face, an edge or a corner. Parts of A and
 * of B that overlap, directly or by way of others, get one label in both maps, named as "lesion 1"; its pair has a
 * PartChange. Numbers follow the volumes: first the parts of A, by A's volume, then new ones, by B's.
 *
 * \param patterns names of pairs, with * and ?
 * \param toSecond maps points of A's space to B's; null for one space
 * \param maximumMemory bytes for the numbers of parts, 4 a voxel of both maps
 * \param pairs those that fit a pattern are replaced by pairs of their parts
 * Throws Failure: Usage for a pattern that fits no pair, and for a label of more than 1000 parts; Memory. */
void
DivideIntoParts(const std::vector<std::string> & patterns,
                const AffineMap * toSecond,
                std::uintmax_t maximumMemory,
                ComparedSide & first,
                ComparedSide & second,
                std::vector<LabelPair> & pairs);

} // namespace rhombic

#endif
