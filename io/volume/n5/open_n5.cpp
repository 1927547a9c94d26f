// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Looks through a container of N5 for the array that is meant, and opens it.
#include "io/volume/n5/open_n5.h"

#include <algorithm>
#include <charconv>
#include <vector>

#include "io/chunks/chunk.h"
#include "io/chunks/chunked_volume.h"
#include "io/file/errors.h"
#include "io/json/json.h"

namespace mw::io {
namespace {

enum class Kind { kArray, kPyramid, kGroup };

bool has_array(const Place& folder) {
  const auto attributes = read_attributes(folder);
  return attributes && attributes->json.is_object() && is_n5_array(attributes->fields());
}

Kind kind_of(const Place& folder) {
  if (has_array(folder)) return Kind::kArray;
  return has_array(folder / "s0") ? Kind::kPyramid : Kind::kGroup;
}

/// Finds arrays and pyramids below a group, within bounds, as links may lead round and round.
class Search {
 public:
  explicit Search(const Place& container) { look(container, "", 0); }

  [[nodiscard]] const std::vector<std::string>& found() const { return found_; }
  /// Whether there was more than is looked through.
  [[nodiscard]] bool gave_up() const { return folders_ >= kMaxFolders; }
  [[nodiscard]] std::string names() const {
    constexpr std::size_t kMax = 30;
    std::string out;
    for (std::size_t i = 0; i < std::min(kMax, found_.size()); ++i) {
      out += (i == 0 ? "" : ", ") + found_[i];
    }
    return found_.size() > kMax || gave_up() ? out + ", ..." : out;
  }

 private:
  static constexpr int kMaxDepth = 8;
  static constexpr int kMaxFolders = 5000;

  void look(const Place& folder, const std::string& prefix, int depth) {
    const auto names = folder.folders();
    if (!names) return;
    for (const std::string& last : *names) {
      if (++folders_ >= kMaxFolders) return;
      const Place child = folder / last;
      const std::string name = prefix + last;
      if (kind_of(child) != Kind::kGroup) {
        found_.push_back(name);
      } else if (depth < kMaxDepth) {
        look(child, name + "/", depth + 1);
      }
    }
  }

  std::vector<std::string> found_;
  int folders_ = 0;
};

Place only_one(const Place& group) {
  if (!group.folders()) {
    fail_input(group.string(), "N5", "is no array, and a server does not list what is in a group",
               "name the array with --dataset, or give its own address");
  }
  const Search search(group);
  if (search.found().size() == 1 && !search.gave_up()) return group / search.found()[0];
  if (search.found().empty()) {
    fail_input(group.string(), "N5", "there is no array in the folder",
               "give the folder of a container or an array");
  }
  fail_input(group.string(), "N5", text("there are several arrays: ", search.names()),
             "choose one with --dataset");
}

/// Returns the folder of a data set; "/volumes/labels" begins at the container.
Place dataset_folder(const Place& container, const std::string& dataset) {
  const std::size_t start = dataset.find_first_not_of('/');
  const std::filesystem::path inside = start == dataset.npos ? "" : dataset.substr(start);
  const bool leaves = std::find(inside.begin(), inside.end(), "..") != inside.end();
  Place folder = container / inside.string();
  if (!leaves && folder.is_folder().value_or(true)) return folder;
  fail_usage("--dataset ", dataset, ": not in ", container.string(), "; it has ",
             Search(container).names());
}

int count_levels(const Place& pyramid) {
  int count = 1;
  while (has_array(pyramid / text("s", count))) ++count;
  return count;
}

Place level_in(const Place& pyramid, int level) {
  const auto folder = [&](int i) { return pyramid / text("s", i); };
  if (level >= 0 && has_array(folder(level))) return folder(level);
  const int count = count_levels(pyramid);
  fail_usage("--scale ", level, ": ", pyramid.string(), " has ", count,
             " levels, 0 (the finest) to ", count - 1);
}

Place array_or_pyramid(const Place& container, const OpenOptions& options) {
  Place folder = options.dataset.empty() ? container : dataset_folder(container, options.dataset);
  return kind_of(folder) == Kind::kGroup ? only_one(folder) : folder;
}

/// Calls take for the attributes; the place of a level of a pyramid needs the metadata of the
/// finest one and of the group.
void with_attributes(const Place& folder, const N5Document& own,
                     const std::function<void(const N5Attributes&)>& take) {
  const auto level = level_of(folder);
  const auto above = level ? folder.parent() : std::nullopt;
  if (!above) return take({.own = own});
  const auto group = read_attributes(above->first);
  const auto finest = *level == 0 ? std::nullopt : read_attributes(above->first / "s0");
  take({.own = own,
        .group = group ? &*group : nullptr,
        .finest = finest ? &*finest : nullptr,
        .level = *level});
}

}  // namespace

std::optional<N5Document> read_attributes(const Place& folder) {
  const Place path = folder / "attributes.json";
  if (!path.is_document() && !path.open_if_there(kMaxJsonBytes)) return std::nullopt;
  return N5Document{.json = read_json(path), .file = path.string()};
}

std::optional<std::size_t> level_of(const Place& folder) {
  const std::string name = folder.last_part();
  if (name.size() < 2 || name[0] != 's') return std::nullopt;
  std::size_t level = 0;
  const char* end = name.data() + name.size();
  const auto parsed = std::from_chars(name.data() + 1, end, level);
  if (parsed.ec != std::errc() || parsed.ptr != end) return std::nullopt;
  return level;
}

Place find_n5_array(const Place& container, const OpenOptions& options) {
  const Place folder = array_or_pyramid(container, options);
  if (kind_of(folder) == Kind::kPyramid) return level_in(folder, options.scale.value_or(0));
  if (options.scale.value_or(0) == 0) return folder;
  fail_usage("--scale ", *options.scale, ": ", folder.string(), " has one resolution");
}

bool is_n5(const Place& folder) {
  return (folder / "attributes.json").is_document() ||
         (folder / "s0" / "attributes.json").is_document() ||
         std::filesystem::path(folder.string()).extension() == ".n5";
}

std::unique_ptr<LabelVolume> open_n5(const Place& container, const OpenOptions& options) {
  const Place folder = find_n5_array(container, options);
  const auto document = read_attributes(folder);
  if (!document) {
    fail_input(folder.string(), "N5", "attributes.json is missing", folder.refusal_or({}));
  }
  N5Array array = parse_n5_array(document->fields());
  VolumeInfo info{.shape = shape_of(array),
                  .type = array.type,
                  .format = "n5",
                  .chunk = block_of(array),
                  .is_far = !folder.is_near()};
  with_attributes(folder, *document, [&](const N5Attributes& attributes) {
    info.space = n5_space(attributes, array, options);
    info.offset = n5_offset(attributes, array);
  });
  const VoxelCoding coding{.type = array.type, .order = ByteOrder::kBig};
  return std::make_unique<ChunkedVolume>(std::move(info), coding, ChunkFill{},
                                         std::make_unique<N5Blocks>(folder, std::move(array)),
                                         options.cache_bytes);
}

std::size_t count_n5_scales(const Place& container, const OpenOptions& options) {
  const Place folder = array_or_pyramid(container, options);
  if (kind_of(folder) != Kind::kPyramid) return 1;
  return static_cast<std::size_t>(count_levels(folder));
}

}  // namespace mw::io
