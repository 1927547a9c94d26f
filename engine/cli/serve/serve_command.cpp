// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// mwmesh serve: a folder of precomputed meshes in neuroglancer.
#include <csignal>
#include <iostream>

#include "engine/cli/command.h"
#include "engine/cli/exit_code.h"
#include "engine/cli/requests.h"
#include "engine/cli/serve/folder_server.h"
#include "engine/cli/serve/view_link.h"
#include "io/file/errors.h"
#include "io/remote/address.h"

namespace mw::cli {
namespace {

struct ServeJob {
  std::filesystem::path folder;
  std::uint16_t port = 0;
  std::string viewer;
};

std::uint16_t parse_port(const std::string& text) {
  std::uint16_t port = 0;
  if (!engine::read_number(text, port)) engine::fail_expected("a port from 0 to 65535", text);
  return port;
}

std::string parse_viewer(const std::string& text) {
  if (io::origin_of(text).empty()) engine::fail_expected("an address such as https://HOST/", text);
  return text;
}

int run_serve(const ServeJob& job) {
  const FolderView view = read_folder_view(job.folder);
  FolderServer server(job.folder, job.port, io::origin_of(job.viewer));
  end_well_if_interrupted();
  (void)std::signal(SIGPIPE, SIG_IGN);  // a link that nobody reads is an error with a message
  std::cout << view_link(view, server.address(), job.viewer) << std::endl;
  if (!std::cout) throw Error(ErrorKind::kResource, "cannot write to standard output");
  std::cerr << "serving until Ctrl-C" << std::endl;
  server.serve();
}

void add_options(OptionSet& options, ServeJob& job) {
  options.add({.name = "folder",
               .value = "FOLDER",
               .help = "what mwmesh surface --format draco or precomputed wrote",
               .group = kInputGroup,
               .flags = "FOLDER,--folder",
               .required = true,
               .assign = into(job.folder)});
  options.add({.name = "port",
               .value = "N",
               .help = "where to listen; 0: any that is free",
               .group = kRunGroup,
               .kind = ValueKind::kInteger,
               .fallback = "0",
               .assign = into(job.port, parse_port)});
  options.add({.name = "viewer",
               .value = "ADDRESS",
               .help = "the neuroglancer that alone may read",
               .group = kRunGroup,
               .fallback = "https://neuroglancer-demo.appspot.com/",
               .assign = into(job.viewer, parse_viewer)});
}

}  // namespace

Command serve_command() {
  const auto job = std::make_shared<ServeJob>();
  Command command{
      .name = "serve",
      .about = "shows precomputed surfaces in neuroglancer: serves them, and prints a link",
      .options = {},
      .run = [job](const OptionSet&) { return run_serve(*job); },
      .note =
          "Ctrl-C ends it.  Only programs on this machine reach it, and of the pages in\n"
          "browsers only those of --viewer.\n"};
  add_options(command.options, *job);
  return command;
}

}  // namespace mw::cli
