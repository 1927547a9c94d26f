// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The labels of a run, packed, so that a later run need only read what has changed, and a note
// about that run.
#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/labels/reading_tiles.h"
#include "io/file/file_descriptor.h"
#include "io/file/sink/atomic_file.h"
#include "io/volume/label_volume.h"

namespace mw::engine {

/// Raw labels by tiles (ReadingTiles), each packed on its own.
///
///     "MWLABELS", version 1; x y z of the shape and of ReadingTiles' chunk, and whether z is
///     fastest; tiles; each tile's offset, size and CRC-32; CRC-32 of all that: numbers of 8 bytes
///     tiles, frames of Zstandard of 8 bytes a voxel
///     the note's checksum, and the note up to the end of the file
class KeptLabels {
 public:
  /// Returns nothing where there is no such file, or one for another shape.
  /// ERRORS: DamagedWork.
  [[nodiscard]] static std::optional<KeptLabels> open(const std::filesystem::path& file,
                                                      Index3 shape);

  [[nodiscard]] const ReadingTiles& tiles() const { return tiles_; }
  /// Returns the labels of a tile, x fastest.  Thread-safe.  ERRORS: DamagedWork.
  [[nodiscard]] std::vector<RawLabel> read(Index3 tile) const;
  /// Returns what is known of a tile's labels without reading them.
  [[nodiscard]] std::uint64_t checksum(Index3 tile) const;
  /// Returns what append_note() added behind the tiles, empty if nothing.  ERRORS: DamagedWork.
  [[nodiscard]] std::string note() const;

 private:
  friend void write_kept_labels(const io::LabelVolume& volume, io::AtomicFile& file, int threads);
  struct Place {
    std::uint64_t offset = 0;
    std::uint64_t size = 0;
    std::uint64_t checksum = 0;
  };

  KeptLabels(io::FileDescriptor file, const io::VolumeInfo& info, std::vector<Place> places)
      : file_(std::move(file)), tiles_(info), places_(std::move(places)) {}

  io::FileDescriptor file_;
  ReadingTiles tiles_;
  std::vector<Place> places_;
};

/// Writes the file that KeptLabels opens.  It reads the volume once, on `threads` threads, each of
/// which holds a tile in memory; the file does not depend on their number.
void write_kept_labels(const io::LabelVolume& volume, io::AtomicFile& file, int threads = 1);

/// Appends a note to that file.  REQUIRES: write_kept_labels() has written it; called once.
void append_note(io::AtomicFile& file, const std::string& note);

/// A volume that is read in some boxes only; everywhere else the labels are those that were kept.
/// Thread safety: that of LabelVolume.
class PatchedVolume : public io::VolumeView {
 public:
  /// changed are boxes of voxels, which may reach out of the volume.  REQUIRES: kept has the
  /// volume's shape; volume and kept outlive it.
  PatchedVolume(const io::LabelVolume& volume, const KeptLabels& kept, std::vector<Box3> changed)
      : VolumeView(volume), kept_(kept), changed_(std::move(changed)) {}

  void read(const Box3& box, std::span<RawLabel> out) const override;

  /// Reads 1 % of the tiles that no box touches, at least as many voxels as eight of full size
  /// have, on `threads` threads, each of which holds a tile.  Which ones depends on the labels that
  /// were kept.  Returns the voxels of the first tile whose labels are not those; nothing if all
  /// are.
  [[nodiscard]] std::optional<Box3> untold_change(int threads) const;

 private:
  [[nodiscard]] bool is_told(const Box3& tile) const;
  [[nodiscard]] std::vector<Index3> sampled_tiles() const;

  const KeptLabels& kept_;
  std::vector<Box3> changed_;
};

}  // namespace mw::engine
