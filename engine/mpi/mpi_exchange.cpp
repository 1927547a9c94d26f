// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The thread that talks to MPI, with its out box, its sends and receives under way, and heartbeats.
#include "engine/mpi/mpi_exchange.h"

#include <mpi.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <deque>
#include <fstream>
#include <future>
#include <list>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "kernels/core/error.h"

namespace mw::engine {
namespace {

using Clock = std::chrono::steady_clock;

/// Tags are the kinds of messages; the transport's own messages have this tag.
constexpr int kOwnTag = 0;
constexpr std::size_t kMaxSends = 256;  ///< the most sends under way at a time
constexpr std::chrono::microseconds kPause{100};
constexpr std::chrono::seconds kBeat{1};

/// Kinds of the transport's own messages.
constexpr std::uint64_t kAlive = ~std::uint64_t{0};
constexpr std::uint64_t kLeaving = ~std::uint64_t{1};

/// The most bytes of one block of a type, since MPI counts them with an int.
constexpr std::size_t kBlockBytes = std::size_t{1} << 30U;

/// Returns a type that sends head and bytes as one message, wherever they lie in memory.
MPI_Datatype type_of(const MessageHead& head, const std::byte* bytes, std::size_t size) {
  std::vector<int> lengths;
  std::vector<MPI_Aint> at;
  const auto add = [&](const void* block, std::size_t length) {
    lengths.push_back(static_cast<int>(length));
    MPI_Get_address(block, &at.emplace_back());
  };
  add(head.data(), sizeof(MessageHead));
  for (std::size_t done = 0; done < size; done += kBlockBytes) {
    add(bytes + done, std::min(kBlockBytes, size - done));
  }
  MPI_Datatype out = MPI_DATATYPE_NULL;
  MPI_Type_create_hindexed(static_cast<int>(at.size()), lengths.data(), at.data(), MPI_BYTE, &out);
  MPI_Type_commit(&out);
  return out;
}

struct Outgoing {
  int to = 0;
  MessageHead head{};
  SharedBytes bytes;
  std::uint64_t number = 0;  ///< counts the callers' messages; 0 for the transport's own
};

/// Keeps bytes until the process ends.  They are never released, not even then, since what they
/// give back to may be gone.
void keep_for_ever(SharedBytes bytes) {
  static std::mutex mutex;
  static auto* const kept = new std::vector<SharedBytes>;  // no destructor runs when it ends
  const std::lock_guard lock(mutex);
  kept->push_back(std::move(bytes));
}

/// True if this is a process of Open MPI that waits for its children.
bool is_launcher(pid_t process) {
  std::ifstream in("/proc/" + std::to_string(process) + "/comm");
  std::string name;
  return std::getline(in, name) && (name == "mpirun" || name == "mpiexec" || name == "orterun" ||
                                    name == "orted" || name == "prterun" || name == "prted");
}

int tag_of(const MessageHead& head) {
  return head[0] <= kMaxKind ? static_cast<int>(head[0]) : kOwnTag;
}

bool is_over(MPI_Request& request) {
  int over = 0;
  MPI_Test(&request, &over, MPI_STATUS_IGNORE);
  return over != 0;
}

}  // namespace

/// All that the thread and its callers share.
class MpiExchange::Transport {
 public:
  Transport() : thread_([this] { run(); }) {
    if (const std::string error = started_.get_future().get(); !error.empty()) {
      thread_.join();
      throw Error(ErrorKind::kInternal, error);
    }
  }
  Transport(const Transport&) = delete;
  Transport& operator=(const Transport&) = delete;
  ~Transport() {
    {
      const std::lock_guard lock(mutex_);
      ending_ = true;
    }
    thread_.join();
  }

  void send(Outgoing message) {
    const std::lock_guard lock(mutex_);
    message.number = next_number_++;
    out_box_.push_back(std::move(message));
  }
  [[nodiscard]] bool is_idle() const {
    const std::lock_guard lock(mutex_);
    return out_box_.empty() && sends_under_way_ == 0;
  }
  void listen(ExchangeListener listener) {
    const std::lock_guard turn(listening_);
    listener_ = std::move(listener);
  }
  /// Waits up to 2 s for sends to end.  Then what is in the out box is never sent, and bytes of
  /// sends under way, which MPI may still read, are kept for ever.
  void let_go() {
    const Clock::time_point until = Clock::now() + std::chrono::seconds(2);
    while (!is_idle() && Clock::now() < until) std::this_thread::sleep_for(kPause);
    const std::lock_guard lock(mutex_);
    if (out_box_.empty() && sends_under_way_ == 0) return;
    kept_below_ = next_number_;
    out_box_.clear();
  }
  /// Returns how many ranks have said that they leave.
  [[nodiscard]] int leaving() const {
    const std::lock_guard lock(mutex_);
    return leaving_;
  }

  int rank = 0;
  int ranks = 1;
  int ranks_here = 1;

 private:
  struct Sending {
    Outgoing message;
    MPI_Request request = MPI_REQUEST_NULL;
  };
  struct Receiving {
    Message message;
    MPI_Request request = MPI_REQUEST_NULL;
  };

  std::string start() {
    int given = 0;
    if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &given) != MPI_SUCCESS ||
        given < MPI_THREAD_FUNNELED) {
      return "MPI cannot be started";
    }
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    MPI_Comm here = MPI_COMM_NULL;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, rank, MPI_INFO_NULL, &here);
    MPI_Comm_size(here, &ranks_here);
    MPI_Comm_free(&here);
    heard_.assign(static_cast<std::size_t>(ranks), Clock::now());
    return "";
  }

  void run() {
    const std::string error = start();
    started_.set_value(error);
    if (!error.empty()) return;
    while (!is_over()) {
      bool busy = start_sends();
      busy |= end_sends();
      busy |= receive_some();
      keep_alive();
      if (!busy) std::this_thread::sleep_for(kPause);
    }
    MPI_Finalize();
  }

  [[nodiscard]] bool is_over() const {
    const std::lock_guard lock(mutex_);
    return ending_ && out_box_.empty() && sends_.empty();
  }

  bool start_sends() {
    bool any = false;
    while (sends_.size() < kMaxSends) {
      std::optional<Outgoing> next;
      {
        const std::lock_guard lock(mutex_);
        if (out_box_.empty()) return any;
        next = std::move(out_box_.front());
        out_box_.pop_front();
        ++sends_under_way_;
      }
      start_send(std::move(*next));
      any = true;
    }
    return any;
  }

  void start_send(Outgoing message) {
    Sending& sending = sends_.emplace_back(Sending{.message = std::move(message)});
    const Outgoing& m = sending.message;
    const bool empty = m.bytes == nullptr || m.bytes->empty();
    MPI_Datatype type =
        type_of(m.head, empty ? nullptr : m.bytes->data(), empty ? 0 : m.bytes->size());
    MPI_Isend(MPI_BOTTOM, 1, type, m.to, tag_of(m.head), MPI_COMM_WORLD, &sending.request);
    MPI_Type_free(&type);  // MPI frees it when the send is over
  }

  bool end_sends() {
    std::list<Sending> over;
    for (auto s = sends_.begin(); s != sends_.end();) {
      const auto sending = s++;
      if (engine::is_over(sending->request)) over.splice(over.end(), sends_, sending);
    }
    if (over.empty()) return false;
    {
      // Bytes are released under the lock, so that let_go() comes before this or after it.
      const std::lock_guard lock(mutex_);
      for (Sending& s : over) {
        if (s.message.number < kept_below_) keep_for_ever(std::move(s.message.bytes));
      }
      over.clear();
      sends_under_way_ = sends_.size();
    }
    const std::lock_guard turn(listening_);
    if (listener_.sent) listener_.sent();
    return true;
  }

  bool receive_some() {
    bool any = start_receives();
    for (auto r = receives_.begin(); r != receives_.end();) {
      if (!engine::is_over(r->request)) {
        ++r;
        continue;
      }
      pass_on(std::move(r->message));
      r = receives_.erase(r);
      any = true;
    }
    return any;
  }

  bool start_receives() {
    bool any = false;
    for (;;) {
      int there = 0;
      MPI_Message handle = MPI_MESSAGE_NULL;
      MPI_Status status;
      MPI_Improbe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &handle, &status);
      if (there == 0) return any;
      MPI_Count size = 0;
      MPI_Get_elements_x(&status, MPI_BYTE, &size);
      Receiving& r = receives_.emplace_back();
      r.message.from = status.MPI_SOURCE;
      const std::size_t bytes = static_cast<std::size_t>(size) - sizeof(MessageHead);
      r.message.room = take_room(status.MPI_TAG, bytes);
      r.message.bytes.resize(bytes);
      MPI_Datatype type = type_of(r.message.head, r.message.bytes.data(), r.message.bytes.size());
      MPI_Imrecv(MPI_BOTTOM, 1, type, &handle, &r.request);
      MPI_Type_free(&type);
      any = true;
    }
  }

  std::shared_ptr<void> take_room(int tag, std::size_t bytes) {
    if (tag == kOwnTag) return nullptr;
    const std::lock_guard turn(listening_);
    if (!listener_.room) return nullptr;
    return listener_.room(static_cast<std::uint64_t>(tag), bytes);
  }

  void pass_on(Message message) {
    heard_[static_cast<std::size_t>(message.from)] = Clock::now();
    if (message.head[0] == kAlive) return;
    if (message.head[0] == kLeaving) {
      const std::lock_guard lock(mutex_);
      ++leaving_;
      return;
    }
    const std::lock_guard turn(listening_);
    if (!listener_.receive) {
      waiting_.push_back(std::move(message));
      return;
    }
    for (Message& before : std::exchange(waiting_, {})) listener_.receive(std::move(before));
    listener_.receive(std::move(message));
  }

  /// Tells all ranks that this one is alive, and ends this process if one of them is silent.
  void keep_alive() {
    const Clock::time_point now = Clock::now();
    if (now - last_beat_ < kBeat) return;
    last_beat_ = now;
    {
      // These came before there was a listener.
      const std::lock_guard turn(listening_);
      if (listener_.receive) {
        for (Message& before : std::exchange(waiting_, {})) listener_.receive(std::move(before));
      }
    }
    for (int other = 0; other < ranks; ++other) {
      if (other == rank) continue;
      if (now - heard_[static_cast<std::size_t>(other)] > std::chrono::seconds(kSilence)) {
        end_for_silence(other);
      }
      if (sends_.size() < kMaxSends) {
        start_send({.to = other, .head = {kAlive, 0, 0, 0}, .bytes = nullptr});
        const std::lock_guard lock(mutex_);
        ++sends_under_way_;
      }
    }
  }

  /// Ends Open MPI's own processes first, since they wait for ever for those they cannot reach.
  [[noreturn]] void end_for_silence(int other) const {
    std::fprintf(stderr,
                 "mwmesh: error: rank %d has not heard from rank %d for %d seconds; the network or "
                 "the process is gone\n",
                 rank, other, kSilence);
    const pid_t parent = ::getppid();
    if (is_launcher(parent)) {
      ::kill(parent, SIGTERM);
      std::this_thread::sleep_for(std::chrono::seconds(5));
      if (::getppid() == parent) ::kill(parent, SIGKILL);
    }
    ::_exit(1);
  }

  std::promise<std::string> started_;
  mutable std::mutex mutex_;  ///< guards the next lines
  std::deque<Outgoing> out_box_;
  std::size_t sends_under_way_ = 0;
  std::uint64_t next_number_ = 1;
  std::uint64_t kept_below_ = 0;  ///< bytes of messages with lower numbers are not released
  int leaving_ = 0;
  bool ending_ = false;

  std::mutex listening_;  ///< guards the next lines; never taken inside mutex_
  ExchangeListener listener_;
  std::vector<Message> waiting_;

  // Only the thread uses the next lines.
  std::list<Sending> sends_;
  std::list<Receiving> receives_;
  std::vector<Clock::time_point> heard_;
  Clock::time_point last_beat_{};
  std::thread thread_;  ///< last: it uses all of the above
};

MpiExchange::MpiExchange() : transport_(std::make_unique<Transport>()) {}
MpiExchange::~MpiExchange() = default;

int MpiExchange::rank() const {
  return transport_->rank;
}
int MpiExchange::ranks() const {
  return transport_->ranks;
}
int MpiExchange::ranks_here() const {
  return transport_->ranks_here;
}
void MpiExchange::send(int to, const MessageHead& head, SharedBytes bytes) {
  transport_->send({to, head, std::move(bytes)});
}
bool MpiExchange::is_idle() const {
  return transport_->is_idle();
}
void MpiExchange::let_go() {
  transport_->let_go();
}
void MpiExchange::listen(ExchangeListener listener) {
  transport_->listen(std::move(listener));
}

void MpiExchange::leave(int code) {
  constexpr std::chrono::seconds kPatience{10};
  constexpr std::chrono::milliseconds kLook{1};
  if (rank() != 0) {
    send(0, {kLeaving, 0, 0, 0}, nullptr);
    // Rank 0 says when its files are complete, or reports an error and ends; mpirun ends this one.
    const Clock::time_point until = Clock::now() + kPatience;
    while (transport_->leaving() == 0 && (code == 0 || Clock::now() < until)) {
      std::this_thread::sleep_for(kLook);
    }
    if (code != 0) ::_exit(code);
  }
  if (code == 0) {
    for (int other = 1; rank() == 0 && other < ranks(); ++other) {
      send(other, {kLeaving, 0, 0, 0}, nullptr);
    }
    transport_.reset();
    std::exit(0);
  }
  const Clock::time_point until = Clock::now() + kPatience;
  while (transport_->leaving() + 1 < ranks() && Clock::now() < until) {
    std::this_thread::sleep_for(kLook);
  }
  std::fflush(nullptr);
  ::_exit(code);
}

}  // namespace mw::engine
