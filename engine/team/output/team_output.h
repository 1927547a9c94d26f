// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The end of a run of several processes that write one mesh together.
#pragma once

#include "engine/output/finish.h"
#include "engine/team/output/line_share.h"
#include "engine/team/team.h"
#include "io/mesh/shared_mesh.h"

namespace mw::engine {

/// Whether all ranks write the mesh: if rank 0 is given one, which it has made, the others join it.
/// Returns when every rank has come here.  mesh: null on a rank that cannot write together.
/// ERRORS: mw::Error(kUsage) of a rank that is to join and cannot; as SharedMesh::join().
[[nodiscard]] bool join_output(Team& team, io::SharedMesh* mesh);

/// Who writes a mesh together, and into what.
struct TeamOutput {
  Team& team;
  const LineShare& share;  ///< the lines of blocks that this rank writes
  io::SharedMesh& file;
};

/// finish() by all ranks: each writes the rows of its own lines, rank 0 gives the file its name.
/// mesh: with the own blocks.  REQUIRES: join_output().
/// ENSURES: the bytes are those of finish() by one process.  Every rank gets the counts; rank 0
/// what it asks to be measured, the same as finish(), but for the shape of interfaces, which needs
/// the whole mesh to pass by one process: FinishedMesh::shape stays empty.
/// Each reads its blocks three times: who references what, which rows are new, and to write.
/// Memory: as finish() of own blocks; 16 bytes a line of all blocks; PartRows and the claims that
/// it takes, which grow with the faces between this rank's lines and others'; 24 bytes a label
/// where something is measured.  ERRORS: those of any rank.
FinishedMesh finish_together(const FinalMesh& mesh, const TeamOutput& output,
                             const OutputOptions& options);

}  // namespace mw::engine
