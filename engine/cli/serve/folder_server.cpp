// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Serves a folder on this machine; this alone knows the library that speaks HTTP.
#include "engine/cli/serve/folder_server.h"

#include <fcntl.h>
#include <microhttpd.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <list>
#include <system_error>
#include <utility>

#include "engine/cli/serve/served_folder.h"
#include "io/file/errors.h"
#include "io/file/file_descriptor.h"
#include "io/remote/address.h"

namespace mw::cli {

/// What the library's calls get.
struct FolderService {
  ServedFolder folder;
  std::string origin;
  /// Those that are open; the one whose last request began longest ago is in front.
  std::list<MHD_Connection*> connections{};
};

namespace {

/// A browser keeps six.  Where there are more, the oldest are closed (note()), some moments later.
/// Each may take two descriptors, of which a process usually gets 1024.
constexpr unsigned kMostConnections = 256;
constexpr unsigned kClosing = 32;                 ///< may wait for that; further ones are refused
constexpr unsigned kPatience = 20;                ///< seconds that a connection may be idle
constexpr std::size_t kHeaderBytes = 32U << 10U;  ///< of a request; more of them are refused
constexpr std::size_t kPieceBytes = 64U << 10U;   ///< are read at a time

/// The headers that every answer has, beside the one that names the origin.
constexpr std::pair<const char*, const char*> kHeaders[] = {
    {"Access-Control-Allow-Headers", "Range"},
    {"Access-Control-Allow-Private-Network", "true"},
    {"Accept-Ranges", "bytes"},
    {"Allow", "GET, HEAD, OPTIONS"},
    {"Content-Type", "application/octet-stream"}};

/// What is sent of a file.
struct Part {
  std::shared_ptr<const io::FileSource> file;
  ByteRange bytes;
};

ssize_t read_piece(void* part, std::uint64_t sent, char* out, std::size_t size) noexcept {
  const auto& [file, bytes] = *static_cast<const Part*>(part);
  try {
    file->read_at(bytes.begin + sent, std::as_writable_bytes(std::span(out, size)));
    return static_cast<ssize_t>(size);
  } catch (const std::exception&) {
    return MHD_CONTENT_READER_END_WITH_ERROR;  // the file was cut, or the disk is broken
  }
}

/// Where an answer goes: pages of the origin may read it.
struct Client {
  MHD_Connection* connection;
  const std::string& origin;
};

/// Returns MHD_NO, which closes the connection, when there is no memory.
MHD_Result send(const Client& to, unsigned status, const Part& part = {},
                const std::string& content_range = {}) {
  auto kept = std::make_unique<Part>(part);
  const std::unique_ptr<MHD_Response, void (*)(MHD_Response*)> response(
      MHD_create_response_from_callback(part.bytes.size(), kPieceBytes, read_piece, kept.get(),
                                        [](void* sent) { delete static_cast<Part*>(sent); }),
      MHD_destroy_response);
  if (!response) return MHD_NO;
  (void)kept.release();
  const auto add = [&](const char* name, const char* value) {
    return MHD_add_response_header(response.get(), name, value) == MHD_YES;
  };
  for (const auto& [name, value] : kHeaders) {
    if (!add(name, value)) return MHD_NO;
  }
  if (!add("Access-Control-Allow-Origin", to.origin.c_str())) return MHD_NO;
  if (!content_range.empty() && !add("Content-Range", content_range.c_str())) return MHD_NO;
  return MHD_queue_response(to.connection, status, response.get());
}

MHD_Result send_file(const Client& to, const std::shared_ptr<const io::FileSource>& file,
                     std::string_view range) {
  const std::uint64_t size = file->size();
  const std::optional<ByteRange> asked = asked_range(range, size);
  if (!asked) return send(to, MHD_HTTP_OK, {file, {0, size}});
  if (asked->empty()) {
    return send(to, MHD_HTTP_RANGE_NOT_SATISFIABLE, {}, io::text("bytes */", size));
  }
  return send(to, MHD_HTTP_PARTIAL_CONTENT, {file, *asked},
              io::text("bytes ", asked->begin, "-", asked->end - 1, "/", size));
}

const char* header_of(const Client& client, const char* name) {
  return MHD_lookup_connection_value(client.connection, MHD_HEADER_KIND, name);
}

MHD_Result answer_request(const Client& to, const ServedFolder& folder, const char* path,
                          std::string_view method) {
  const char* const host = header_of(to, "Host");
  if (host == nullptr || !io::is_on_this_machine(io::text("http://", host))) {
    return send(to, MHD_HTTP_MISDIRECTED_REQUEST);
  }
  if (method == "OPTIONS") return send(to, MHD_HTTP_NO_CONTENT);
  const bool is_get = method == "GET";
  if (!is_get && method != "HEAD") return send(to, MHD_HTTP_METHOD_NOT_ALLOWED);
  const auto file = folder.open(path);
  if (!file) return send(to, MHD_HTTP_NOT_FOUND);
  const char* const range = header_of(to, "Range");
  return send_file(to, file, is_get && range != nullptr ? range : "");
}

/// The library calls this when a connection begins and ends.  Of too many those are closed that
/// have asked for nothing for the longest time, so that one client does not keep others out.
void note(void* to, MHD_Connection* connection, void** /*unused*/,
          MHD_ConnectionNotificationCode code) noexcept {
  auto& open = static_cast<FolderService*>(to)->connections;
  if (code == MHD_CONNECTION_NOTIFY_CLOSED) {
    open.remove(connection);
    return;
  }
  open.push_back(connection);
  auto oldest = open.begin();
  for (std::size_t left = open.size(); left > kMostConnections; --left) {
    const auto* const info = MHD_get_connection_info(*oldest++, MHD_CONNECTION_INFO_CONNECTION_FD);
    if (info != nullptr) (void)::shutdown(info->connect_fd, SHUT_RDWR);
  }
}

/// The library calls this once before it reads a request's body, for each piece of that, and at the
/// end.  Only an answer at the end leaves the connection open for another request.
MHD_Result answer(void* to, MHD_Connection* connection, const char* path, const char* method,
                  const char* /*version*/, const char* /*body*/, std::size_t* body_bytes,
                  void** begun) noexcept {
  auto& service = *static_cast<FolderService*>(to);
  if (*begun == nullptr || *body_bytes > 0) {
    auto& open = service.connections;
    if (*begun == nullptr) open.splice(open.end(), open, std::ranges::find(open, connection));
    *begun = to;
    *body_bytes = 0;  // nothing here needs a body
    return MHD_YES;
  }
  try {
    return answer_request({connection, service.origin}, service.folder, path, method);
  } catch (const std::exception&) {
    return MHD_NO;  // closes the connection
  }
}

/// Leaves a path with a NUL as it is: the library would take what is before the NUL for all of it.
std::size_t unescape(void* /*unused*/, MHD_Connection* /*unused*/, char* path) noexcept {
  return std::strstr(path, "%00") != nullptr ? std::strlen(path) : MHD_http_unescape(path);
}

[[noreturn]] void fail_to_listen(std::uint16_t port, int error) {
  const std::string why = io::text("cannot listen on port ", port,
                                   " of 127.0.0.1: ", std::generic_category().message(error));
  if (port == 0) throw Error(ErrorKind::kResource, why);
  io::fail_usage("--port: ", why, "; without --port it takes one that is free");
}

/// Returns a socket that listens on a port of the loopback; 0 takes one that is free.
io::FileDescriptor listen_on(std::uint16_t port) {
  sockaddr_in loopback{};
  loopback.sin_family = AF_INET;
  loopback.sin_port = htons(port);
  loopback.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  io::FileDescriptor out(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  const int yes = 1;  // a port whose last connections have just ended is free
  const auto* const address = reinterpret_cast<const sockaddr*>(&loopback);
  if (!out.valid() || ::setsockopt(out.get(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes) != 0 ||
      ::bind(out.get(), address, sizeof loopback) != 0 || ::listen(out.get(), SOMAXCONN) != 0) {
    fail_to_listen(port, errno);
  }
  return out;
}

}  // namespace

FolderServer::FolderServer(const std::filesystem::path& folder, std::uint16_t port,
                           std::string origin)
    : service_(new FolderService{ServedFolder(folder), std::move(origin)}),
      daemon_(nullptr, MHD_stop_daemon) {
  const io::FileDescriptor socket = listen_on(port);
  const int own = ::fcntl(socket.get(), F_DUPFD_CLOEXEC, 0);  // the library closes its socket
  if (own < 0) fail_to_listen(port, errno);
  // Without flags the library waits by select() in serve().  When it waits by epoll(), it may
  // overlook that a client has nothing more to send, and keep the connection until its patience
  // ends.
  daemon_.reset(MHD_start_daemon(
      MHD_NO_FLAG, port, nullptr, nullptr, answer, service_.get(), MHD_OPTION_LISTEN_SOCKET, own,
      MHD_OPTION_CONNECTION_LIMIT, kMostConnections + kClosing, MHD_OPTION_CONNECTION_TIMEOUT,
      kPatience, MHD_OPTION_CONNECTION_MEMORY_LIMIT, kHeaderBytes, MHD_OPTION_UNESCAPE_CALLBACK,
      unescape, nullptr, MHD_OPTION_NOTIFY_CONNECTION, note, service_.get(), MHD_OPTION_END));
  if (!daemon_) fail_to_listen(port, errno);
}

FolderServer::~FolderServer() = default;

std::string FolderServer::address() const {
  return io::text("http://127.0.0.1:",
                  MHD_get_daemon_info(daemon_.get(), MHD_DAEMON_INFO_BIND_PORT)->port);
}

void FolderServer::serve() {
  while (MHD_run_wait(daemon_.get(), -1) == MHD_YES) continue;
  throw Error(ErrorKind::kResource, address() + ": the system accepts no more connections");
}

}  // namespace mw::cli
