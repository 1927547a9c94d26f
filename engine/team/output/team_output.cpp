// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/team/output/team_output.h"

#include "engine/output/remembered.h"
#include "engine/output/written_block.h"
#include "engine/team/output/part_rows.h"
#include "engine/team/shared_lists.h"
#include "engine/team/team.h"
#include "io/file/errors.h"

namespace mw::engine {
namespace {

/// How many rows a line has, or all lines before it.
struct LineRows {
  std::uint64_t vertices = 0;
  std::uint64_t tets = 0;
};

/// Where the rows of own lines begin, and how many all lines have.
struct AllRows {
  std::vector<LineRows> own;  ///< by own line, ascending
  LineRows all;
};

/// mine has the numbers of rows of own lines, ascending.
AllRows rows_before(Team& team, const LineShare& share, const std::vector<LineRows>& mine) {
  std::vector<std::vector<LineRows>> said;
  for (const auto& bytes : team.gather(bytes_of(mine.data(), mine.size()))) {
    said.push_back(list_of<LineRows>(bytes));
  }
  AllRows out;
  std::vector<std::size_t> next(said.size());
  for (std::size_t line = 0; line < share.lines(); ++line) {
    const std::uint32_t owner = share.owner(line);
    if (share.is_own(line)) out.own.push_back(out.all);
    const LineRows& rows = said[owner].at(next[owner]++);
    out.all.vertices += rows.vertices;
    out.all.tets += rows.tets;
  }
  return out;
}

/// The part of the mesh that one rank writes.
class PartOfMesh {
 public:
  PartOfMesh(const FinalMesh& mesh, const TeamOutput& output, const OutputOptions& options)
      : team_(output.team),
        share_(output.share),
        blocks_(mesh.blocks),
        volume_(mesh.volume),
        layers_(options.layers),
        selection_(options.wanted, volume_.table()),
        remembered_(options.hold),
        uses_(mesh.grid) {}

  /// Makes the first two passes.  Returns how many rows there are in all.
  LineRows number() {
    std::vector<std::vector<Claim>> mine = claim();
    const std::vector<std::vector<Claim>> theirs = swap_claims(mine);
    PartRows& rows = rows_.emplace(share_, uses_, std::move(mine), theirs);
    for_each_own_block(
        share_, [](std::size_t) {},
        [&](Index3 b) {
          const BlockMesh block = load(b);
          remember(block);
          rows.count(b, block.vertices);
        });
    rows.take_firsts(swap_lists(team_, rows.firsts()));
    place(rows);
    rows.take_given_rows(swap_lists(team_, rows.given_rows()));
    rows.take_found_rows(swap_lists(team_, rows.found_rows()));
    return places_.all;
  }

  /// Makes the third pass.
  void write(io::SharedMesh& mesh, const OutputOptions& options) {
    mesh.begin(header(options));
    std::size_t line = 0;
    for_each_own_block(
        share_,
        [&](std::size_t) {
          const LineRows& at = places_.own[line++];
          mesh.go_to({.vertex = at.vertices, .tet = at.tets});
        },
        [&](Index3 b) { write(b, mesh); });
    mesh.sync();
  }

  [[nodiscard]] io::MeshHeader header(const OutputOptions& options) const {
    return header_of(volume_, selection_, places_.all.tets, options.promises);
  }

 private:
  /// Loads a block; throws if another rank has failed, since the mesh will not be complete then.
  [[nodiscard]] BlockMesh load(Index3 b) {
    if (const auto failure = team_.failure()) throw *failure;
    BlockMesh block = blocks_.load(b);
    selection_.apply(block);
    return block;
  }

  void remember(const BlockMesh& block) {
    remembered_.rows(Remembered::kBytesPerRow * (rows_->remembered() + block.vertices.size()));
  }

  std::vector<std::vector<Claim>> claim() {
    Claims claims(share_, uses_, [&](std::uint64_t bytes) { remembered_.shared(bytes); });
    for_each_own_block(
        share_, [&](std::size_t) { lines_.emplace_back(); },
        [&](Index3 b) {
          const BlockMesh block = load(b);
          uses_.add(b, uses_.lines_of(block.vertices));
          claims.add(b, block.vertices);
          lines_.back().tets += block.tets.size();
        });
    return claims.take(static_cast<std::size_t>(team_.ranks()));
  }

  std::vector<std::vector<Claim>> swap_claims(const std::vector<std::vector<Claim>>& mine) {
    std::uint64_t made = 0;
    for (const auto& of_rank : mine) made += of_rank.size();
    const auto expect = [&](std::uint64_t coming) {
      remembered_.shared(kBytesPerClaim * made + kBytesPerJudged * coming);
    };
    return swap_lists(team_, mine, {.expect = expect});
  }

  void place(PartRows& rows) {
    const std::vector<std::uint64_t> vertices = rows.new_vertices();
    for (std::size_t i = 0; i < lines_.size(); ++i) lines_[i].vertices = vertices.at(i);
    places_ = rows_before(team_, share_, lines_);
    std::vector<std::uint64_t> first_rows;
    for (const LineRows& before : places_.own) first_rows.push_back(before.vertices);
    rows.place(first_rows);
  }

  void write(Index3 b, io::SharedMesh& mesh) {
    WrittenBlock made = written_block(load(b), volume_, layers_);
    remember(made.block);
    const PartRows::Assigned assigned = rows_->assign(b, made.block.vertices);
    std::vector<io::Position> added;
    for (std::size_t v : assigned.added) added.push_back(made.positions[v]);
    mesh.write_vertices(added);
    give_rows(made.tets, assigned.rows);
    mesh.write_tets(made.tets, made.labels);
  }

  Team& team_;
  const LineShare& share_;
  FinalBlocks& blocks_;
  const io::DenseVolume& volume_;
  Index3 layers_;
  LabelSelection selection_;
  Remembered remembered_;
  VertexUses uses_;
  std::vector<LineRows> lines_;  ///< of own lines, ascending
  AllRows places_;
  std::optional<PartRows> rows_;
};

}  // namespace

bool join_output(Team& team, io::SharedMesh* mesh) {
  const bool says = team.is_first() && mesh != nullptr;
  const std::string place = team.gather(says ? mesh->place() : std::string()).at(0);
  if (place.empty()) return false;
  if (mesh == nullptr) {
    io::fail_usage(
        "this process writes no part of the mesh, which rank 0 wants; "
        "start all of them with one command line");
  }
  if (!team.is_first()) mesh->join(place);
  return true;
}

FinishedMesh finish_together(const FinalMesh& mesh, const TeamOutput& output,
                             const OutputOptions& options) {
  Team& team = output.team;
  PartOfMesh part(mesh, output, options);
  const LineRows all = part.number();
  if (team.is_first()) output.file.lay_out(part.header(options), all.vertices);
  (void)team.gather(std::string());  // no rank opens the file until it has its size
  part.write(output.file, options);
  (void)team.gather(std::string());  // all rows are on the disk
  if (team.is_first()) output.file.finish();
  return {.vertices = all.vertices, .tets = all.tets};
}

}  // namespace mw::engine
