// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The end of a run of several processes that write one mesh together.
#pragma once

#include "engine/output/finish.h"
#include "engine/team/blocks/partition.h"
#include "engine/team/team.h"
#include "io/mesh/shared_mesh.h"

namespace mw::engine {

/// Returns true if all ranks write the mesh: if rank 0 has made one, the others join it.
/// Returns when every rank has called it.  mesh is null on a rank that cannot write with others.
/// ERRORS: those of SharedMesh::join(); mw::Error(kUsage) of a rank that has to join and cannot.
[[nodiscard]] bool join_output(Team& team, io::SharedMesh* mesh);

/// Who writes a mesh together, and into what.
struct TeamOutput {
  Team& team;
  const LineShare& share;  ///< the lines of blocks that this rank writes
  io::SharedMesh& file;
};

/// Does what finish() does by all ranks: each writes the rows of its own lines, rank 0 gives the
/// file its name.  mesh has the blocks of this rank.  REQUIRES: join_output() returned true.
/// ENSURES: the bytes are those of finish() by one process.  Every rank gets the counts; rank 0
/// gets all that it asks to be measured, except the shape of interfaces: that needs the whole mesh
/// to pass by one process, so FinishedMesh::shape stays empty.
/// Each rank reads its blocks three times: for what they reference, for new rows, and to write.
/// Memory: that of finish() for own blocks; 16 bytes for each line of all blocks; that of PartRows
/// and Claims, which grows with the faces between this rank's lines and others'; 24 bytes a label
/// where something is measured.  ERRORS: those of any rank.
FinishedMesh finish_together(const FinalMesh& mesh, const TeamOutput& output,
                             const OutputOptions& options);

}  // namespace mw::engine
