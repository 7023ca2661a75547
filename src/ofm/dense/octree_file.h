// Semantic octrees as OctoMap files.
#pragma once

#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>

#include <filesystem>
#include <memory>
#include <ostream>
#include <span>
#include <string>

#include "ofm/dense/semantic_octree.h"

namespace ofm {

/// The tree as OctoMap's own: log-odds and colour of every voxel that is known (free ones are
/// white, OctoMap's "no colour"; with MapColor::kLabel occupied ones have LabelColor of their
/// class). Eight voxels are joined only where occupancy and colour are equal.
std::unique_ptr<octomap::ColorOcTree> MakeColorOcTree(const SemanticOctree& octree,
                                                      MapColor color = MapColor::kAppearance);

/// False where the voxel is free, unknown or beyond the grid's limits.
bool IsOccupied(const octomap::ColorOcTree& octree, const VoxelIndex& voxel);

/// Writes a .ot file: occupancy in full and colour; octovis, octomap_server and
/// octomap::AbstractOcTree::read open it as a ColorOcTree. Throws Error where writing fails.
void WriteColorOcTree(std::ostream& stream, const SemanticOctree& octree,
                      MapColor color = MapColor::kAppearance);

/// Reads a .ot file of a ColorOcTree. Throws Error that names the file: missing, of another kind,
/// or truncated. (octomap::AbstractOcTree::read would talk on the standard error stream, and makes
/// up what a truncated file lacks.)
std::unique_ptr<octomap::ColorOcTree> LoadColorOcTree(const std::filesystem::path& path);

/// Writes a .bt file: each voxel free or occupied; octomap::OcTree::readBinary opens it.
void WriteBinaryOcTree(std::ostream& stream, const SemanticOctree& octree);

/// Writes the labels beside an octree as CSV: a header line, then "x,y,z,class_id,class,confidence"
/// for every occupied voxel with a label: its centre [m], the class's name (empty where class_names
/// has none) and the class's probability, 0 to 1. docs/dense_map.md describes the format.
void WriteVoxelLabels(std::ostream& stream, const SemanticOctree& octree,
                      std::span<const std::string> class_names);

}  // namespace ofm
