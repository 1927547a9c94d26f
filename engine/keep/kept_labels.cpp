// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/keep/kept_labels.h"

#include <fcntl.h>

#include <algorithm>
#include <array>

#include "engine/store/journal/work_file.h"
#include "engine/system/in_order.h"
#include "engine/window/window_grid.h"
#include "io/codec/checksums.h"
#include "io/codec/codec.h"
#include "io/codec/hasher.h"
#include "io/file/byte_order.h"
#include "kernels/core/index.h"

namespace mw::engine {
namespace {

constexpr std::uint64_t kLabelsMagic = 0x534C4542414C574DU;  // "MWLABELS"
constexpr std::uint64_t kVersion = 2;
constexpr std::size_t kHeadNumbers = 10;
constexpr int kLabelPackLevel = 1;

[[noreturn]] void fail_damaged(const char* reason) {
  throw DamagedWork("labels", reason);
}

std::vector<std::byte> bytes_of(const std::vector<std::uint64_t>& numbers) {
  std::vector<std::byte> out(numbers.size() * sizeof(std::uint64_t));
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    io::store_little(numbers[i], out.data() + i * sizeof(std::uint64_t));
  }
  return out;
}

std::vector<std::uint64_t> numbers_in(std::span<const std::byte> bytes) {
  std::vector<std::uint64_t> out(bytes.size() / sizeof(std::uint64_t));
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i] =
        io::load<std::uint64_t>(bytes.data() + i * sizeof(std::uint64_t), io::ByteOrder::kLittle);
  }
  return out;
}

std::vector<std::uint64_t> read_numbers(int file, std::uint64_t offset, std::size_t count) {
  std::vector<std::byte> bytes(count * sizeof(std::uint64_t));
  if (io::read_all(file, offset, bytes).bytes != bytes.size()) fail_damaged("it ends too early");
  return numbers_in(bytes);
}

io::VolumeInfo layout_of(const std::vector<std::uint64_t>& head) {
  const auto number = [&](std::size_t i) { return static_cast<std::int64_t>(head[i]); };
  io::VolumeInfo info;
  info.shape = {number(2), number(3), number(4)};
  info.chunk = {number(5), number(6), number(7)};
  info.z_fastest = head[8] != 0;
  return info;
}

}  // namespace

std::optional<KeptLabels> KeptLabels::open(const std::filesystem::path& path, Index3 shape) {
  io::FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file.valid()) return std::nullopt;
  std::vector<std::uint64_t> head = read_numbers(file.get(), 0, kHeadNumbers);
  if (head[0] != kLabelsMagic || head[1] != kVersion) fail_damaged("it begins as another file");
  const io::VolumeInfo info = layout_of(head);
  if (!(info.shape == shape)) return std::nullopt;
  const std::uint64_t tiles = head[9];
  if (tiles != static_cast<std::uint64_t>(ReadingTiles(info).count().product())) {
    fail_damaged("its number of tiles is wrong");
  }
  const std::vector<std::uint64_t> index = read_numbers(
      file.get(), kHeadNumbers * sizeof(std::uint64_t), static_cast<std::size_t>(3 * tiles + 1));
  head.insert(head.end(), index.begin(), index.end() - 1);
  if (io::checksum(bytes_of(head)) != index.back()) fail_damaged("its checksum is wrong");
  std::vector<Place> places;
  for (std::size_t i = 0; i + 1 < index.size(); i += 3) {
    places.push_back({index[i], index[i + 1], index[i + 2]});
  }
  return KeptLabels(std::move(file), info, std::move(places));
}

std::vector<RawLabel> KeptLabels::read(Index3 tile) const {
  const Place place = places_[raster(tile, tiles_.count())];
  std::vector<std::byte> packed(place.size);
  if (io::read_all(file_.get(), place.offset, packed).bytes != packed.size()) {
    fail_damaged("it ends too early");
  }
  if (io::checksum(packed) != place.checksum) fail_damaged("a tile's checksum is wrong");
  const auto voxels = static_cast<std::size_t>(tiles_.box(tile).voxels());
  try {
    const std::vector<std::byte> bytes =
        io::unpack_zstd(packed, voxels * sizeof(RawLabel), "labels");
    if (bytes.size() == voxels * sizeof(RawLabel)) return numbers_in(bytes);
  } catch (const Error&) {
    // It is reported below.
  }
  fail_damaged("a tile cannot be unpacked");
}

std::uint64_t KeptLabels::checksum(Index3 tile) const {
  return places_[raster(tile, tiles_.count())].checksum;
}

std::string KeptLabels::note() const {
  std::uint64_t end = 0;
  for (const Place& place : places_) end = std::max(end, place.offset + place.size);
  std::vector<std::byte> bytes;
  for (std::array<std::byte, 4096> part;;) {
    const std::size_t read = io::read_all(file_.get(), end + bytes.size(), part).bytes;
    bytes.insert(bytes.end(), part.begin(), part.begin() + static_cast<std::ptrdiff_t>(read));
    if (read < part.size()) break;
  }
  if (bytes.empty()) return {};
  if (bytes.size() < sizeof(std::uint64_t)) fail_damaged("its note ends too early");
  const std::span<const std::byte> all(bytes), text = all.subspan(sizeof(std::uint64_t));
  if (io::load<std::uint64_t>(all.data(), io::ByteOrder::kLittle) != io::checksum(text)) {
    fail_damaged("the checksum of its note is wrong");
  }
  return {reinterpret_cast<const char*>(text.data()), text.size()};
}

void append_note(io::AtomicFile& file, const std::string& note) {
  file.append(bytes_of({io::checksum(std::as_bytes(std::span(note)))}));
  file.append(note);
}

void write_kept_labels(const io::LabelVolume& volume, io::AtomicFile& file, int threads) {
  const io::VolumeInfo& info = volume.info();
  const ReadingTiles tiles(info);
  const auto number = [](std::int64_t v) { return static_cast<std::uint64_t>(v); };
  const std::uint64_t count = number(tiles.count().product());
  std::vector<std::uint64_t> head{kLabelsMagic,
                                  kVersion,
                                  number(info.shape.x),
                                  number(info.shape.y),
                                  number(info.shape.z),
                                  number(info.chunk.x),
                                  number(info.chunk.y),
                                  number(info.chunk.z),
                                  std::uint64_t{info.z_fastest},
                                  count};
  const std::size_t head_bytes = (kHeadNumbers + 3 * count + 1) * sizeof(std::uint64_t);
  file.append(std::vector<std::byte>(head_bytes));
  io::ZstdPacker packer(kLabelPackLevel);
  std::vector<std::byte> packed;
  const std::vector<Box3> boxes = tiles.boxes({});
  const auto read = [&](std::size_t tile) {
    std::vector<RawLabel> labels(static_cast<std::size_t>(boxes[tile].voxels()));
    volume.read(boxes[tile], labels);
    return labels;
  };
  const auto append = [&](std::size_t /*tile*/, std::vector<RawLabel>&& labels) {
    packed.clear();
    if constexpr (io::kHostOrder == io::ByteOrder::kLittle) {
      packer.append(std::as_bytes(std::span(labels)), packed);
    } else {
      packer.append(bytes_of(labels), packed);
    }
    head.push_back(file.appended());
    head.push_back(packed.size());
    head.push_back(io::checksum(packed));
    file.append(packed);
  };
  const WorkInOrder how{.threads = threads, .at_once = static_cast<std::size_t>(threads)};
  each_in_order<std::vector<RawLabel>>(how, boxes.size(), read, append);
  head.push_back(io::checksum(bytes_of(head)));
  file.write_at(0, bytes_of(head));
}

void PatchedVolume::read(const Box3& box, std::span<RawLabel> out) const {
  const Box3 over = kept_.tiles().over(box);
  std::vector<RawLabel> labels;
  for_each_index(over, [&](Index3 tile) {
    const Box3 tile_box = kept_.tiles().box(tile), part = intersection(tile_box, box);
    if (!is_told(tile_box)) {
      return copy_box<RawLabel>(part, tile_box, kept_.read(tile), box, out);
    }
    labels.resize(static_cast<std::size_t>(part.voxels()));
    below().read(part, labels);
    copy_box<RawLabel>(part, part, labels, box, out);
  });
}

bool PatchedVolume::is_told(const Box3& tile) const {
  return std::any_of(changed_.begin(), changed_.end(),
                     [&](const Box3& c) { return !is_empty(intersection(c, tile)); });
}

/// Returns one tile of each of equal parts of those that no box touches.
std::vector<Index3> PatchedVolume::sampled_tiles() const {
  constexpr std::int64_t kLeast = 8, kOneOf = 100;
  const ReadingTiles& tiles = kept_.tiles();
  std::vector<Index3> untold;
  io::DigestMaker labels;
  for_each_index(tiles.count(), [&](Index3 tile) {
    if (is_told(tiles.box(tile))) return;
    untold.push_back(tile);
    labels.add(kept_.checksum(tile));
  });
  const auto all = static_cast<std::int64_t>(untold.size());
  const std::int64_t least = kLeast * ReadingTiles::kMaxVoxels / tiles.box({0, 0, 0}).voxels();
  const auto count = static_cast<int>(std::min(all, std::max(least, (all + kOneOf - 1) / kOneOf)));
  const io::ContentDigest seed = labels.finish();
  std::vector<Index3> out;
  for (SequencePart part{.index = 0, .count = count}; part.index < count; ++part.index) {
    io::DigestMaker draw;
    draw.add(seed);
    draw.add(static_cast<std::uint64_t>(part.index));
    const auto size = static_cast<std::uint64_t>(part.end(all) - part.begin(all));
    out.push_back(untold[static_cast<std::size_t>(part.begin(all)) + draw.finish().first % size]);
  }
  return out;
}

std::optional<Box3> PatchedVolume::untold_change(int threads) const {
  const std::vector<Index3> tiles = sampled_tiles();
  std::optional<Box3> out;
  const auto is_other = [&](std::size_t i) {
    const Box3 box = kept_.tiles().box(tiles[i]);
    std::vector<RawLabel> labels(static_cast<std::size_t>(box.voxels()));
    below().read(box, labels);
    return labels != kept_.read(tiles[i]);
  };
  each_in_order<bool>({.threads = threads, .at_once = static_cast<std::size_t>(threads)},
                      tiles.size(), is_other, [&](std::size_t i, bool&& other) {
                        if (other && !out) out = kept_.tiles().box(tiles[i]);
                      });
  return out;
}

}  // namespace mw::engine
