// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sends requests by libcurl, and judges what comes back.
#include "io/remote/http_client.h"

#include <curl/curl.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <mutex>
#include <semaphore>
#include <thread>
#include <vector>

#include "io/file/errors.h"
#include "io/file/text_numbers.h"
#include "io/remote/address.h"
#include "io/remote/http_headers.h"
#include "io/remote/wait_stop.h"

namespace mw::io {
/// The result of an attempt.
struct HttpClient::Verdict {
  enum class Kind { kDone, kRetry, kFail } kind = Kind::kDone;
  ErrorKind error = ErrorKind::kInput;
  std::string reason;
  std::string way_out;
  bool is_hopeless = false;  ///< a retry hardly ever helps

  static Verdict retry(ErrorKind error, std::string reason, std::string way_out) {
    return {Kind::kRetry, error, std::move(reason), std::move(way_out)};
  }
  static Verdict failure(std::string reason, std::string way_out) {
    return {Kind::kFail, ErrorKind::kInput, std::move(reason), std::move(way_out)};
  }
};

namespace {

constexpr long kOk = 200;
constexpr long kPartial = 206;
constexpr long kForbidden = 403;
constexpr long kNotFound = 404;
constexpr long kRangeBeyondEnd = 416;
/// The most bytes that are read of an error's body before the connection is closed.
constexpr std::uint64_t kMaxErrorBody = 64U << 10U;
/// The most bytes and lines of an attempt's headers and trailers.  The library keeps them all, and
/// has bounds of its own, which differ between versions; those of lines begin at 5,000.
constexpr std::uint64_t kMaxHeaders = 256U << 10U, kMaxHeaderLines = 4000;
/// The most bytes that are read up to the end of a part where the server sends whole files only.
constexpr std::uint64_t kMaxUnasked = 64ULL << 20U;
constexpr const char* kTryLater = "try again later; a run that was saved goes on with --resume";
constexpr const char* kPackedPart = "the part is packed (Content-Encoding)";
constexpr const char* kBrokenServer = "ask those who run the server, or copy the volume to a disk";

/// Starts the library once, before it is used by threads.
void start_library() {
  static const CURLcode kStarted = curl_global_init(CURL_GLOBAL_DEFAULT);
  if (kStarted != CURLE_OK) throw Error(ErrorKind::kResource, "libcurl cannot be started");
}

/// Returns the header Authorization with the value of the environment variable.
std::string authorization_header() {
  const char* value = std::getenv(kAuthorizationVariable);  // NOLINT(concurrency-mt-unsafe)
  if (value == nullptr || *value == '\0') return {};
  if (std::strpbrk(value, "\r\n") != nullptr) {
    fail_usage(kAuthorizationVariable, ": has more than one line");
  }
  return text("Authorization: ", value);
}

/// Returns the file of certificates of authorities: that of SSL_CERT_FILE, none where the library's
/// own path (Debian's) is on this system, else one at another system's path.
std::string certificates() {
  std::error_code ignored;
  const char* chosen = std::getenv("SSL_CERT_FILE");  // NOLINT(concurrency-mt-unsafe)
  if (chosen != nullptr && *chosen != '\0') return chosen;
  const char* own = curl_version_info(CURLVERSION_NOW)->cainfo;
  if (own != nullptr && std::filesystem::exists(own, ignored)) return {};
  for (const char* path : {"/etc/ssl/certs/ca-certificates.crt", "/etc/pki/tls/certs/ca-bundle.crt",
                           "/etc/ssl/ca-bundle.pem", "/etc/ssl/cert.pem"}) {
    if (std::filesystem::exists(path, ignored)) return path;
  }
  return {};
}

struct FreeHandle {
  void operator()(CURL* handle) const { curl_easy_cleanup(handle); }
};
struct FreeList {
  void operator()(curl_slist* list) const { curl_slist_free_all(list); }
};
using Handle = std::unique_ptr<CURL, FreeHandle>;
using HeaderList = std::unique_ptr<curl_slist, FreeList>;

void append_header(HeaderList& list, const std::string& header) {
  curl_slist* longer = curl_slist_append(list.get(), header.c_str());
  if (longer == nullptr) throw std::bad_alloc();
  static_cast<void>(list.release());
  list.reset(longer);
}

/// A request of a chain of redirects, and the address at which the chain began.
struct Hop {
  const std::string& address;
  const std::string& first;
};

/// Makes the settings of all requests.  The library does not follow redirects itself, as it would
/// look up the hosts that these lead to in .netrc, too.
void set_up(CURL* curl, const HttpLimits& limits, const Hop& hop) {
  static const std::string kCertificates = certificates();
  const bool is_safe = hop.first.starts_with("https://");
  const bool may_know = is_same_server(hop.address, hop.first) && !is_open_to_all(hop.address);
  curl_easy_reset(curl);
  curl_easy_setopt(curl, CURLOPT_URL, hop.address.c_str());
  curl_easy_setopt(curl, CURLOPT_PROTOCOLS_STR, is_safe ? "https" : "http,https");
  // What is for this machine, a password perhaps, must not go to another one that is a proxy.
  if (is_on_this_machine(hop.address)) curl_easy_setopt(curl, CURLOPT_NOPROXY, "*");
  curl_easy_setopt(curl, CURLOPT_NOSIGNAL, 1L);
  curl_easy_setopt(curl, CURLOPT_CONNECTTIMEOUT, limits.connect_seconds);
  curl_easy_setopt(curl, CURLOPT_LOW_SPEED_LIMIT, 1024L);
  curl_easy_setopt(curl, CURLOPT_LOW_SPEED_TIME, limits.stalled_seconds);
  curl_easy_setopt(curl, CURLOPT_USERAGENT, "mwmesh");
  curl_easy_setopt(curl, CURLOPT_NETRC,
                   static_cast<long>(may_know ? CURL_NETRC_OPTIONAL : CURL_NETRC_IGNORED));
  if (!kCertificates.empty()) curl_easy_setopt(curl, CURLOPT_CAINFO, kCertificates.c_str());
}

/// Returns where the answer redirects; empty when it does not.
std::string redirect_of(CURL* curl) {
  const char* next = nullptr;
  curl_easy_getinfo(curl, CURLINFO_REDIRECT_URL, &next);
  return next == nullptr ? std::string() : next;
}

/// ERRORS: what WaitStop throws meanwhile.
void wait_for(std::chrono::milliseconds left) {
  constexpr std::chrono::milliseconds kSlice{100};
  for (; left.count() > 0; left -= kSlice) {
    WaitStop::ask();
    std::this_thread::sleep_for(std::min(left, kSlice));
  }
}

}  // namespace

/// Handles of the library, each of which keeps its connection open between requests.
class HttpClient::Connections {
 public:
  explicit Connections(int count) : free_(count) { idle_.reserve(static_cast<std::size_t>(count)); }

  /// A handle until the loan ends; waits while all are lent.
  class Loan {
   public:
    explicit Loan(Connections& from) : from_(from), handle_(from.take()) {}
    ~Loan() { from_.give_back(std::move(handle_)); }
    Loan(const Loan&) = delete;
    Loan& operator=(const Loan&) = delete;
    [[nodiscard]] CURL* handle() const { return handle_.get(); }

   private:
    Connections& from_;
    Handle handle_;
  };

 private:
  [[nodiscard]] Handle take() {
    free_.acquire();
    const std::lock_guard lock(mutex_);
    Handle handle;
    if (idle_.empty()) {
      handle.reset(curl_easy_init());
    } else {
      handle = std::move(idle_.back());
      idle_.pop_back();
    }
    if (handle) return handle;
    free_.release();
    throw Error(ErrorKind::kResource, "libcurl has no memory for a connection");
  }
  void give_back(Handle handle) {
    {
      const std::lock_guard lock(mutex_);
      idle_.push_back(std::move(handle));
    }
    free_.release();
  }

  std::counting_semaphore<> free_;
  std::mutex mutex_;
  std::vector<Handle> idle_;
};

/// A request, and the result of its last attempt.
struct HttpClient::Exchange {
  const std::string& address;
  // These are for a request for a whole file.
  std::uint64_t max = 0;
  BodySink* sink = nullptr;
  bool may_be_refused = false;  ///< whether status 403 is an answer
  // These are for a request for a part.
  std::uint64_t offset = 0;
  std::span<std::byte> out{};

  HttpHeaders headers{};
  std::uint64_t header_bytes = 0;  ///< trailers count, too
  std::uint64_t header_lines = 0;
  std::uint64_t received = 0;  ///< of the body
  std::uint64_t taken = 0;     ///< of a part
  bool is_too_large = false;
  bool is_enough = false;                     ///< the rest of the body is not wanted
  bool is_ended = false;                      ///< the body came to its end
  const char* lie = nullptr;                  ///< what is wrong with the answer
  bool is_lie_of_all = false;                 ///< all answers of this server are like that
  std::exception_ptr thrown{};                ///< what the sink or WaitStop threw
  std::array<char, CURL_ERROR_SIZE> words{};  ///< what the library says about an error
  std::chrono::seconds wanted_wait{0};        ///< what the server asks for

  [[nodiscard]] bool is_part() const { return sink == nullptr; }
  /// Returns whether the status is one behind which what was asked for comes.
  [[nodiscard]] bool has_body() const {
    return headers.status == kOk || (is_part() && headers.status == kPartial);
  }
  /// Returns the whole file's size, or nothing when the answer does not tell it.
  [[nodiscard]] std::optional<std::uint64_t> file_bytes() const;
  [[nodiscard]] Verdict perform(CURL* curl, const HttpLimits& limits,
                                const std::string& authorization);

 private:
  static std::size_t on_body(char* bytes, std::size_t one, std::size_t count,
                             void* target) noexcept;
  static std::size_t on_header(char* bytes, std::size_t one, std::size_t count,
                               void* target) noexcept;
  static int on_progress(void* target, curl_off_t, curl_off_t, curl_off_t, curl_off_t) noexcept;
  [[nodiscard]] CURLcode transfer(CURL* curl, const std::string& authorization);
  void begin();
  [[nodiscard]] bool take(std::span<const std::byte> bytes);
  [[nodiscard]] Verdict judge(CURLcode code) const;
  [[nodiscard]] bool take_whole(std::span<const std::byte> bytes);
  [[nodiscard]] bool take_part(std::span<const std::byte> bytes);
  [[nodiscard]] bool take_unasked(std::span<const std::byte> bytes);
  [[nodiscard]] Verdict judge_failure(CURLcode code) const;
  [[nodiscard]] Verdict judge_status() const;
  [[nodiscard]] Verdict judge_part() const;
};

void HttpClient::Exchange::begin() {
  headers = {};
  header_bytes = header_lines = received = taken = 0;
  is_too_large = is_enough = is_ended = is_lie_of_all = false;
  lie = nullptr;
  words[0] = '\0';
  wanted_wait = {};
  if (sink != nullptr) sink->restart();
}

/// Takes bytes of the body; false to end the transfer.
bool HttpClient::Exchange::take(std::span<const std::byte> bytes) {
  const std::uint64_t before = received;
  received += bytes.size();
  if (headers.status == kOk && !is_part()) return take_whole(bytes);
  if (headers.status == kPartial && is_part()) return take_part(bytes);
  if (headers.status == kOk && is_part()) {
    received = before;
    return take_unasked(bytes);
  }
  return received <= kMaxErrorBody;
}

bool HttpClient::Exchange::take_whole(std::span<const std::byte> bytes) {
  is_too_large = received > max;
  if (is_too_large) return false;
  try {
    sink->take(bytes);
  } catch (...) {
    thrown = std::current_exception();
    return false;
  }
  return true;
}

bool HttpClient::Exchange::take_part(std::span<const std::byte> bytes) {
  if (taken == 0) {
    const auto range = parse_content_range(headers.content_range);
    const std::uint64_t last = offset + out.size() - 1;
    if (headers.is_packed()) lie = kPackedPart;
    if (!range)
      lie = "the answer does not say which part it is, or of how many bytes (Content-Range)";
    if (range && (range->first != offset || range->last != std::min(last, range->file_bytes - 1))) {
      lie = "the answer is another part than the one asked for (Content-Range)";
    }
  }
  if (bytes.size() > out.size() - taken) lie = "the body is longer than the part asked for";
  if (lie != nullptr) return false;
  std::copy(bytes.begin(), bytes.end(), out.begin() + static_cast<std::ptrdiff_t>(taken));
  taken += bytes.size();
  return true;
}

/// Takes the part out of a whole file, which some servers send instead.  Where they do not say how
/// large it is (in chunks, or packed), its end tells.
bool HttpClient::Exchange::take_unasked(std::span<const std::byte> bytes) {
  const bool has_size = file_bytes().has_value();
  if (offset + out.size() > kMaxUnasked) {
    lie =
        "the server sends whole files only, not parts of them (status 200 instead of 206), and a "
        "part behind the first 64 MiB is needed";
  } else if (!has_size && received > kMaxUnasked) {
    lie =
        "the server sends whole files only, not parts of them (status 200 instead of 206), does "
        "not say how large they are, and this one has more than 64 MiB";
  } else if (!has_size && !headers.has_end()) {
    lie =
        "the server sends whole files only, not parts of them (status 200 instead of 206), and "
        "does not say where they end (Content-Length or chunks)";
  }
  is_lie_of_all = lie != nullptr;
  if (lie != nullptr) return false;
  const std::uint64_t skipped = std::min<std::uint64_t>(
      bytes.size(), received < offset ? offset - received : std::uint64_t{0});
  received += bytes.size();
  bytes = bytes.subspan(skipped);
  bytes = bytes.first(std::min<std::size_t>(bytes.size(), out.size() - taken));
  std::copy(bytes.begin(), bytes.end(), out.begin() + static_cast<std::ptrdiff_t>(taken));
  taken += bytes.size();
  is_enough = has_size && taken == out.size();
  return !is_enough;
}

std::optional<std::uint64_t> HttpClient::Exchange::file_bytes() const {
  if (headers.status == kPartial) {
    const auto range = parse_content_range(headers.content_range);
    return range ? std::optional(range->file_bytes) : std::nullopt;
  }
  const auto length = parse_count(headers.content_length);
  if (!headers.is_packed() && length) return length;
  return is_ended ? std::optional(received) : std::nullopt;
}

HttpClient::Verdict HttpClient::Exchange::judge(CURLcode code) const {
  if (thrown) std::rethrow_exception(thrown);
  if (lie != nullptr) {
    Verdict verdict = Verdict::retry(ErrorKind::kInput, lie, kBrokenServer);
    verdict.is_hopeless = is_lie_of_all;
    return verdict;
  }
  if (is_too_large || is_enough) return {};
  if (is_part() && headers.status == kPartial && headers.is_packed()) {
    return Verdict::retry(ErrorKind::kInput, kPackedPart, kBrokenServer);
  }
  // The body behind a status that is an error does not matter.
  if (code != CURLE_OK && (code != CURLE_WRITE_ERROR || has_body())) return judge_failure(code);
  if (!has_body()) return judge_status();
  return is_part() ? judge_part() : Verdict{};
}

HttpClient::Verdict HttpClient::Exchange::judge_failure(CURLcode code) const {
  const std::string reason = words[0] != '\0' ? words.data() : curl_easy_strerror(code);
  switch (code) {
    case CURLE_TOO_MANY_REDIRECTS:
      return Verdict::failure("the server redirects again and again", "check the address");
    case CURLE_UNSUPPORTED_PROTOCOL:
    case CURLE_URL_MALFORMAT:
      return Verdict::failure(reason, "check the address, and where it redirects");
    case CURLE_PEER_FAILED_VERIFICATION:
    case CURLE_SSL_CACERT_BADFILE:
      return Verdict::failure(reason,
                              "let SSL_CERT_FILE name the certificates that are to be trusted");
    case CURLE_PARTIAL_FILE:
    case CURLE_BAD_CONTENT_ENCODING:
      return Verdict::retry(ErrorKind::kInput, reason, kBrokenServer);
    case CURLE_COULDNT_RESOLVE_HOST:
    case CURLE_COULDNT_RESOLVE_PROXY: {
      Verdict verdict =
          Verdict::retry(ErrorKind::kResource, reason, "check the address and the network");
      verdict.is_hopeless = true;
      return verdict;
    }
    default:
      return Verdict::retry(ErrorKind::kResource, reason, kTryLater);
  }
}

HttpClient::Verdict HttpClient::Exchange::judge_status() const {
  const long status = headers.status;
  const std::string reason = text("the server answers with status ", status);
  if (status == kNotFound || (status == kForbidden && may_be_refused)) return {};
  if (status == kPartial) {
    return Verdict::retry(ErrorKind::kInput,
                          "the server answers with a part (status 206), and the whole file was "
                          "asked for",
                          kBrokenServer);
  }
  if (status == 401 || status == kForbidden) {
    return Verdict::failure(reason + (status == 401 ? " (unauthorized)" : " (forbidden)"),
                            way_past_refusal(address));
  }
  if (status == 408 || status == 425 || status == 429 || status >= 500) {
    return Verdict::retry(ErrorKind::kResource, reason, kTryLater);
  }
  if (status == kRangeBeyondEnd) {
    Verdict verdict = Verdict::retry(ErrorKind::kInput, text("the file ends before byte ", offset),
                                     "get a whole copy of the store");
    verdict.is_hopeless = true;
    return verdict;
  }
  return Verdict::failure(reason, "check the address");
}

HttpClient::Verdict HttpClient::Exchange::judge_part() const {
  const auto size = file_bytes();
  // take_part() has not looked at an empty body.
  if (!size || taken == 0) {
    return Verdict::retry(ErrorKind::kInput,
                          "the answer has no body, or does not say of which part", kBrokenServer);
  }
  const std::uint64_t wanted =
      std::min<std::uint64_t>(out.size(), *size > offset ? *size - offset : 0);
  if (taken == wanted) return {};
  return Verdict::retry(ErrorKind::kInput,
                        text("the body ends after ", taken, " of ", wanted, " bytes of the part"),
                        kBrokenServer);
}

/// libcurl calls this for each header; nothing that C++ throws may pass through it.
std::size_t HttpClient::Exchange::on_header(char* bytes, std::size_t /*one*/, std::size_t count,
                                            void* target) noexcept {
  auto& exchange = *static_cast<Exchange*>(target);
  exchange.header_bytes += count;
  if (exchange.header_bytes > kMaxHeaders || ++exchange.header_lines > kMaxHeaderLines) {
    exchange.lie = "the answer has more than 256 KiB or 4,000 lines of headers and trailers";
    exchange.is_lie_of_all = true;
    return 0;
  }
  try {
    exchange.headers.add({bytes, count});
    return count;
  } catch (...) {
    return 0;
  }
}

/// libcurl calls this about once a second, also while the server is silent.
int HttpClient::Exchange::on_progress(void* target, curl_off_t /*to_come*/, curl_off_t /*came*/,
                                      curl_off_t /*to_send*/, curl_off_t /*sent*/) noexcept {
  try {
    WaitStop::ask();
    return 0;
  } catch (...) {
    static_cast<Exchange*>(target)->thrown = std::current_exception();
    return 1;
  }
}

HttpClient::HttpClient(const HttpLimits& limits)
    : limits_(limits), authorization_(authorization_header()) {
  start_library();
  connections_ = std::make_unique<Connections>(limits_.connections);
}

HttpClient::~HttpClient() = default;

std::size_t HttpClient::Exchange::on_body(char* bytes, std::size_t /*one*/, std::size_t count,
                                          void* target) noexcept {
  const auto arrived = std::as_bytes(std::span<const char>(bytes, count));
  return static_cast<Exchange*>(target)->take(arrived) ? count : 0;
}

/// Makes one attempt, through all redirects.  ERRORS: what the sink throws, and WaitStop.
HttpClient::Verdict HttpClient::Exchange::perform(CURL* curl, const HttpLimits& limits,
                                                  const std::string& authorization) {
  std::string at = address;
  for (long followed = 0; followed <= limits.redirects; ++followed) {
    set_up(curl, limits, {at, address});
    const CURLcode code =
        transfer(curl, is_same_server(at, address) ? authorization : std::string());
    const std::string next = code == CURLE_OK ? redirect_of(curl) : std::string();
    if (next.empty()) return judge(code);
    at = next;
  }
  return judge(CURLE_TOO_MANY_REDIRECTS);
}

/// Sends one request.  REQUIRES: set_up() was called.
CURLcode HttpClient::Exchange::transfer(CURL* curl, const std::string& authorization) {
  begin();
  HeaderList lines;
  if (!authorization.empty()) append_header(lines, authorization);
  if (is_part()) append_header(lines, "Accept-Encoding: identity");
  curl_easy_setopt(curl, CURLOPT_HTTPHEADER, lines.get());
  // The library unpacks what it may ask for; of parts, what comes packed although a line of its own
  // asks for the opposite.
  curl_easy_setopt(curl, CURLOPT_ACCEPT_ENCODING, "");
  const std::string range = is_part() ? text(offset, "-", offset + out.size() - 1) : std::string();
  if (is_part()) curl_easy_setopt(curl, CURLOPT_RANGE, range.c_str());
  curl_easy_setopt(curl, CURLOPT_ERRORBUFFER, words.data());
  curl_easy_setopt(curl, CURLOPT_HEADERFUNCTION, &on_header);
  curl_easy_setopt(curl, CURLOPT_HEADERDATA, this);
  curl_easy_setopt(curl, CURLOPT_NOPROGRESS, 0L);
  curl_easy_setopt(curl, CURLOPT_XFERINFOFUNCTION, &on_progress);
  curl_easy_setopt(curl, CURLOPT_XFERINFODATA, this);
  curl_easy_setopt(curl, CURLOPT_WRITEFUNCTION, &on_body);
  curl_easy_setopt(curl, CURLOPT_WRITEDATA, this);
  const CURLcode code = curl_easy_perform(curl);
  is_ended = code == CURLE_OK;
  curl_off_t wait = 0;
  curl_easy_getinfo(curl, CURLINFO_RETRY_AFTER, &wait);
  wanted_wait = std::chrono::seconds(std::clamp<curl_off_t>(wait, 0, 3600));
  // The library must not keep pointers to what ends here.
  curl_easy_setopt(curl, CURLOPT_HTTPHEADER, nullptr);
  curl_easy_setopt(curl, CURLOPT_ERRORBUFFER, nullptr);
  return code;
}

HttpClient::Verdict HttpClient::attempt(Exchange& exchange) const {
  const Connections::Loan loan(*connections_);
  return exchange.perform(loan.handle(), limits_, authorization_);
}

void HttpClient::run(Exchange& exchange) const {
  if (!authorization_.empty() && is_open_to_all(exchange.address)) {
    fail_usage(exchange.address, ": ", kAuthorizationVariable,
               " is set, and http:// would show it on the way; use https://, or unset it");
  }
  std::chrono::milliseconds wait = limits_.first_wait;
  for (int done = 1;; ++done) {
    const Verdict verdict = attempt(exchange);
    if (verdict.kind == Verdict::Kind::kDone) return;
    const int attempts = verdict.is_hopeless ? std::min(3, limits_.attempts) : limits_.attempts;
    if (verdict.kind == Verdict::Kind::kFail || done >= attempts) {
      const std::string tried = done > 1 ? text(" (", done, " attempts)") : "";
      throw Error(verdict.error,
                  text(exchange.address, ": ", verdict.reason, tried, "; ", verdict.way_out));
    }
    const std::chrono::milliseconds asked = std::min(exchange.wanted_wait, limits_.max_wait);
    wait_for(std::max(wait, asked));
    wait = std::min<std::chrono::milliseconds>(2 * wait, limits_.max_wait);
  }
}

Presence HttpClient::whole(Exchange& exchange) const {
  run(exchange);
  if (exchange.is_too_large) return Presence::kTooLarge;
  if (exchange.headers.status == kForbidden) return Presence::kRefused;
  return exchange.headers.status == kNotFound ? Presence::kAbsent : Presence::kThere;
}

Presence HttpClient::get(const std::string& address, std::uint64_t max, BodySink& sink) const {
  Exchange exchange{.address = address, .max = max, .sink = &sink};
  return whole(exchange);
}

Presence HttpClient::probe(const std::string& address, std::uint64_t max, BodySink& sink) const {
  Exchange exchange{.address = address, .max = max, .sink = &sink, .may_be_refused = true};
  return whole(exchange);
}

std::string HttpClient::way_past_refusal(const std::string& address) {
  const std::string way_out =
      is_open_to_all(address)
          ? "use https://, as http:// would show a password on the way"
          : text("let ", kAuthorizationVariable,
                 " be the value of its header, such as 'Bearer TOKEN', or name the host in .netrc");
  return way_out + "; some stores say so of what is not there, too";
}

std::optional<RemotePart> HttpClient::get_part(const std::string& address, std::uint64_t offset,
                                               std::span<std::byte> out) const {
  if (out.empty()) return RemotePart{};
  Exchange exchange{.address = address, .offset = offset, .out = out};
  run(exchange);
  if (exchange.headers.status == kNotFound) return std::nullopt;
  return RemotePart{.bytes = exchange.taken,
                    .file_bytes = *exchange.file_bytes(),
                    .version = exchange.headers.version()};
}

}  // namespace mw::io
