// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// mwmesh-codt: constrained Delaunay triangulations for the engine.
#include "engine/codt/worker/constrained_delaunay.h"
#include "engine/codt/worker/serve.h"

int main() {
  mw::engine::codt::serve(mw::engine::codt::constrained_delaunay);
  return 0;
}
