// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/finish/sample.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "io/file/scratch/external_sort.h"

namespace mw::engine {
namespace {

/// The cell of a tet, its number and its rows.
using PlacedTet = std::array<std::uint64_t, 6>;
using Values = io::PagedArray<double>;

/// Tets of one cell, which are looked at together.
class Batch {
 public:
  Batch(io::ScratchMesh& mesh, ImageSampler& sampler, Values& values)
      : mesh_(mesh), sampler_(sampler), values_(values) {}

  /// True if the tet must wait for the next batch.
  [[nodiscard]] bool is_closed_to(const PlacedTet& tet) const {
    return !numbers_.empty() && (tet[0] != cell_ || numbers_.size() == sampler_.most_tets());
  }
  void add(const PlacedTet& tet) {
    cell_ = tet[0];
    numbers_.push_back(tet[1]);
    tets_.push_back({tet[2], tet[3], tet[4], tet[5]});
  }
  void flush() {
    if (numbers_.empty()) return;
    const std::vector<io::Position> positions = give_local_rows();
    const std::vector<double> found = sampler_.of(positions, tets_);
    const std::size_t width = sampler_.names().size();
    for (std::size_t i = 0; i < found.size(); ++i) {
      values_.change(numbers_[i / width] * width + i % width, [&](double& v) { v = found[i]; });
    }
    numbers_.clear();
    tets_.clear();
  }

 private:
  /// Replaces rows of the mesh by rows of the list that is returned.
  std::vector<io::Position> give_local_rows() {
    std::vector<std::uint64_t> rows;
    for (const io::TetRows& tet : tets_) rows.insert(rows.end(), tet.begin(), tet.end());
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    for (io::TetRows& tet : tets_) {
      for (std::uint64_t& row : tet) {
        const auto at = std::lower_bound(rows.begin(), rows.end(), row) - rows.begin();
        row = static_cast<std::uint64_t>(at);
      }
    }
    std::vector<io::Position> out;
    out.reserve(rows.size());
    for (const std::uint64_t row : rows) out.push_back(mesh_.vertex(row));
    return out;
  }

  io::ScratchMesh& mesh_;
  ImageSampler& sampler_;
  Values& values_;
  std::uint64_t cell_ = 0;
  std::vector<std::uint64_t> numbers_;
  std::vector<io::TetRows> tets_;
};

}  // namespace

void sample(io::ScratchMesh& mesh, ImageSampler& sampler, std::size_t sort_bytes,
            const std::function<void()>& between) {
  io::ExternalSort<6> by_cell(mesh.folder(), sort_bytes);
  mesh.each_tet_batch([&](const io::TetBatch& batch) {
    between();
    for (std::size_t t = 0; t < batch.tets.size(); ++t) {
      const auto& [a, b, c, d] = batch.tets[t];
      by_cell.add({sampler.cell_of(mesh.corners(batch.tets[t])), batch.first + t, a, b, c, d});
    }
  });
  Values values(mesh.folder(), mesh.tet_count() * sampler.names().size());
  Batch batch(mesh, sampler, values);
  by_cell.each([&](const PlacedTet& tet) {
    if (batch.is_closed_to(tet)) {
      between();
      batch.flush();
    }
    batch.add(tet);
  });
  batch.flush();
  const std::size_t width = sampler.names().size();
  mesh.add_columns(sampler.names(), [&](const io::TetBatch& some, std::size_t t, auto& rows) {
    for (std::size_t k = 0; k < width; ++k) {
      rows.push_back(values.get((some.first + t) * width + k));
    }
  });
}

std::uint64_t bytes_to_sample(const ImageSampler& sampler, std::size_t sort_bytes) {
  constexpr std::uint64_t kPages = std::uint64_t{8} << 20U;
  return sampler.buffer_bytes() + sort_bytes + kPages;
}

}  // namespace mw::engine
