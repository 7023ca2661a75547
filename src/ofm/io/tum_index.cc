#include "ofm/io/tum_index.h"

#include <fmt/format.h>

#include "ofm/base/error.h"
#include "ofm/base/time.h"
#include "ofm/io/table_file.h"

namespace ofm {
namespace {

namespace fs = std::filesystem;

ListedImage ReadImage(const TableFile& file, const TableFile::Row& row, std::size_t field) {
  return {file.Stamp(row, field), file.path().parent_path() / row.fields[field + 1], file.path(),
          row.line};
}

/// rgb.txt or depth.txt.
std::vector<ListedImage> ReadList(const fs::path& path) {
  if (!fs::exists(path)) {
    throw Error(path,
                "does not exist; a TUM RGB-D folder has rgb.txt and depth.txt, or "
                "associations.txt");
  }
  const TableFile file(path);
  if (file.rows().empty()) throw Error(path, "lists no image; it needs lines 'timestamp file'");
  std::vector<ListedImage> images;
  StampOrder order;
  for (const TableFile::Row& row : file.rows()) {
    file.RequireColumns(row, "timestamp file");
    images.push_back(ReadImage(file, row, 0));
    order.Require(file, row, images.back().stamp_ns);
  }
  return images;
}

std::vector<TumEntry> ReadAssociations(const fs::path& path) {
  const TableFile file(path);
  if (file.rows().empty()) {
    throw Error(path, "lists no frame; remove it, and rgb.txt and depth.txt will be used");
  }
  std::vector<TumEntry> entries;
  StampOrder order;
  for (const TableFile::Row& row : file.rows()) {
    file.RequireColumns(row, "timestamp colour_file timestamp depth_file");
    entries.push_back({ReadImage(file, row, 0), ReadImage(file, row, 2)});
    order.Require(file, row, entries.back().color.stamp_ns);
  }
  return entries;
}

std::vector<std::int64_t> Stamps(const std::vector<ListedImage>& images) {
  std::vector<std::int64_t> stamps;
  for (const ListedImage& image : images) stamps.push_back(image.stamp_ns);
  return stamps;
}

std::vector<TumEntry> AssociateLists(const fs::path& folder, double max_difference_s) {
  const std::vector<ListedImage> colors = ReadList(folder / "rgb.txt");
  const std::vector<ListedImage> depths = ReadList(folder / "depth.txt");
  std::vector<TumEntry> entries;
  for (const auto [color, depth] :
       AssociateStamps(Stamps(colors), Stamps(depths), SecondsToNanoseconds(max_difference_s))) {
    entries.push_back({colors[color], depths[depth]});
  }
  if (entries.empty()) {
    throw Error(folder, fmt::format("no image of rgb.txt has one of depth.txt within {} s; check "
                                    "that both lists are of one recording",
                                    max_difference_s));
  }
  return entries;
}

}  // namespace

TumIndex ReadTumIndex(const fs::path& folder, double max_difference_s) {
  if (!fs::exists(folder)) throw Error(folder, "does not exist; name a TUM RGB-D folder");
  if (!fs::is_directory(folder)) throw Error(folder, "is no folder; name a TUM RGB-D folder");
  TumIndex index;
  index.folder = folder;
  const fs::path associations = folder / "associations.txt";
  index.entries = fs::exists(associations) ? ReadAssociations(associations)
                                           : AssociateLists(folder, max_difference_s);
  const fs::path groundtruth = folder / "groundtruth.txt";
  if (fs::exists(groundtruth)) index.groundtruth = groundtruth;
  return index;
}

}  // namespace ofm
