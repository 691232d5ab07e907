#include "apps/studio/studio_server.h"

#include <sys/random.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <httplib.h>
#include <nlohmann/json.hpp>

#include "apps/options/scene_options.h"
#include "apps/studio/studio_folder.h"
#include "apps/studio/studio_jobs.h"
#include "apps/studio/studio_map.h"
#include "apps/studio/studio_page.h"
#include "apps/studio/studio_sights.h"
#include "apps/studio/studio_sky.h"
#include "sim/base/error.h"
#include "sim/scene/file/scene_toml.h"

namespace vegard::apps {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostBytes = 500u << 20;  // of an upload
constexpr std::size_t kMostJson = 1u << 20;
constexpr const char* kAddress = "127.0.0.1";
constexpr int kNothing = 204, kForbidden = 403, kNotFound = 404, kRefused = 422, kTooLarge = 413,
              kWrongType = 415;

/// 32 hexadecimal digits that nobody can guess.
std::string random_word() {
  unsigned char bytes[16];
  if (::getrandom(bytes, sizeof bytes, 0) != static_cast<ssize_t>(sizeof bytes))
    throw sim::Error(sim::ErrorKind::unwritable_output, "the system gives no random numbers");
  std::string word;
  for (const unsigned char byte : bytes) word += fmt::format("{:02x}", byte);
  return word;
}

void answer(httplib::Response& response, const Json& json) {
  response.set_header("Cross-Origin-Resource-Policy", "same-origin");
  response.set_content(json.dump(-1, ' ', false, Json::error_handler_t::replace), "application/json");
}

void refuse(httplib::Response& response, int status, const std::string& why) {
  response.status = status;
  answer(response, {{"error", why}});
}

/// The texts of a list in JSON. Throws Json::exception if it is none.
std::vector<std::string> texts(const Json& list) { return list.get<std::vector<std::string>>(); }

}  // namespace

class StudioServer::Routes {
 public:
  Routes(const StudioFolder& folder, StudioJobs& jobs, int port)
      : folder_(folder), jobs_(jobs), secret_(random_word()) {
    server_.set_payload_max_length(kMostBytes);
    server_.set_read_timeout(30);
    server_.set_tcp_nodelay(true);  // else small answers wait for the browser to acknowledge their head
    server_.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
      return admits(request, response) ? httplib::Server::HandlerResponse::Unhandled
                                       : httplib::Server::HandlerResponse::Handled;
    });
    server_.set_default_headers({{"X-Content-Type-Options", "nosniff"},
                                 {"Referrer-Policy", "no-referrer"},
                                 {"Cache-Control", "no-store"}});
    const std::string root = "/" + secret_ + "/";
    server_.Get(root, [this](const httplib::Request&, httplib::Response& response) {
      send_page("index.html", response);
    });
    server_.Get(root + "page/([a-z_.]+)",
                [this](const httplib::Request& request, httplib::Response& response) {
                  send_page(request.matches[1], response);
                });
    server_.Get(root + "files", [this](const httplib::Request&, httplib::Response& response) {
      response.set_header("Cross-Origin-Resource-Policy", "same-origin");
      response.set_content(folder_.listing_json(), "application/json");
    });
    server_.Get(root + "sky", [this](const httplib::Request& request, httplib::Response& response) {
      send_sky(request.get_param_value("camera"), response);
    });
    server_.Get(root + "map", [this](const httplib::Request& request, httplib::Response& response) {
      send_map(request.get_param_value("run"), response);
    });
    for (const auto& [name, tell] :
         {std::pair{"views", &studio_views}, {"sight", &studio_sight}, {"seen", &studio_seen}})
      server_.Post(
          root + name, [this, tell = tell](const httplib::Request& request, httplib::Response& response) {
            with_json(request, response, [&](const Json& asked) { answer(response, tell(folder_, asked)); });
          });
    server_.Get(root + "file/(.+)", [this](const httplib::Request& request, httplib::Response& response) {
      send_file(request.matches[1], response);
    });
    server_.Get(root + R"(job/(\d{1,6}))",
                [this](const httplib::Request& request, httplib::Response& response) {
                  tell_job(request, response);
                });
    server_.Post(root + R"(job/(\d{1,6})/stop)",
                 [this](const httplib::Request& request, httplib::Response& response) {
                   if (jobs_.stop(std::stoi(request.matches[1])))
                     answer(response, Json::object());
                   else
                     refuse(response, kNotFound, "there is no such command");
                 });
    server_.Post(root + "run", [this](const httplib::Request& request, httplib::Response& response) {
      with_json(request, response, [&](const Json& asked) {
        const auto output =
            asked.value("shown", false) ? StudioJobs::Output::shown : StudioJobs::Output::kept;
        answer(response, {{"job", jobs_.begin(texts(asked.at("words")), output)}});
      });
    });
    server_.Get(root + R"(picture/(\d{1,6}))",
                [this](const httplib::Request& request, httplib::Response& response) {
                  send_path(jobs_.picture(std::stoi(request.matches[1])), response);
                });
    server_.Post(root + "save", [this](const httplib::Request& request, httplib::Response& response) {
      with_json(request, response, [&](const Json& asked) { save(asked, response); });
    });
    server_.Post(root + "upload",
                 [this](const httplib::Request& request, httplib::Response& response,
                        const httplib::ContentReader& reader) { take(request, response, reader); });
    if (port == 0)
      port_ = server_.bind_to_any_port(kAddress);
    else if (server_.bind_to_port(kAddress, port))
      port_ = port;
    if (port_ <= 0)
      throw sim::Error(sim::ErrorKind::unwritable_output,
                       fmt::format("the port {} of {} cannot be had", port, kAddress))
          .hint("without --port any free one is taken");
    thread_ = std::thread([this] { server_.listen_after_bind(); });
  }

  ~Routes() {
    // stop() is not heard by a server that has not begun.
    for (int i = 0; i < 1000 && !server_.is_running(); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    server_.stop();
    thread_.join();
  }
  Routes(const Routes&) = delete;
  Routes& operator=(const Routes&) = delete;

  std::string address() const { return fmt::format("http://{}:{}/{}/", kAddress, port_, secret_); }

  double idle_s() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - last_request_.load()).count();
  }

 private:
  /// Whether a request comes from the page itself.
  bool admits(const httplib::Request& request, httplib::Response& response) {
    const std::string host = request.get_header_value("Host"), origin = request.get_header_value("Origin");
    const std::string here = fmt::format("{}:{}", kAddress, port_),
                      named = fmt::format("localhost:{}", port_);
    const bool is_host = host == here || host == named;
    // A report in its sandbox is of no origin ("null") and loads its pictures; it can read nothing of what it
    // loads.
    const bool is_picture = request.method == "GET" && request.path.find("/file/") == secret_.size() + 1;
    const bool is_origin = origin.empty() || origin == "http://" + host || (is_picture && origin == "null");
    const bool knows = request.path.compare(0, secret_.size() + 2, "/" + secret_ + "/") == 0;
    if (is_host && is_origin && knows) {
      last_request_ = std::chrono::steady_clock::now();
      return true;
    }
    if (is_host && request.path == "/favicon.ico") {  // browsers ask for it beside any file
      response.status = kNothing;
      response.set_header("Cross-Origin-Resource-Policy", "cross-origin");
      return false;
    }
    refuse(response, knows ? kForbidden : kNotFound, "this is a studio of another page");
    return false;
  }

  static void send_page(const std::string& name, httplib::Response& response) {
    for (const EmbeddedFile& page : studio_pages())
      if (page.name == name) {
        response.set_header(
            "Content-Security-Policy",
            "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; "
            "connect-src 'self'; frame-src 'self'; frame-ancestors 'none'; base-uri 'none'; form-action "
            "'none'");
        response.set_header("Cross-Origin-Resource-Policy", "same-origin");
        response.set_content(page.bytes.data(), page.bytes.size(), content_type(name));
        return;
      }
    refuse(response, kNotFound, "there is no such page");
  }

  void send_file(const std::string& name, httplib::Response& response) const {
    send_path(folder_.path_of(name), response);
  }

  static void send_path(const std::string& path, httplib::Response& response) {
    auto stream = std::make_shared<std::ifstream>(path, std::ios::binary | std::ios::ate);
    const auto size =
        path.empty() || !*stream ? std::streamoff(-1) : static_cast<std::streamoff>(stream->tellg());
    if (size < 0 || size > static_cast<std::streamoff>(1) << 40)
      return refuse(response, kNotFound, "there is no such file");
    // Reports have scripts of their own; in a sandbox they are of no origin, and reach nothing here.
    response.set_header("Content-Security-Policy",
                        "sandbox allow-scripts allow-popups; default-src 'none'; script-src 'unsafe-inline'; "
                        "style-src 'unsafe-inline'; img-src 'self' data: blob:; font-src data:");
    // A sandboxed report has no origin; its pictures are of this one.
    response.set_header("Cross-Origin-Resource-Policy", "cross-origin");
    response.set_content_provider(
        static_cast<std::size_t>(size), content_type(path),
        [stream](std::size_t from, std::size_t length, httplib::DataSink& sink) {
          char block[1 << 16];
          stream->clear();
          stream->seekg(static_cast<std::streamoff>(from));
          stream->read(block, static_cast<std::streamsize>(std::min(length, sizeof block)));
          return stream->gcount() > 0 && sink.write(block, static_cast<std::size_t>(stream->gcount()));
        });
  }

  void send_sky(const std::string& camera, httplib::Response& response) const {
    try {
      const std::string json = studio_sky_json(sim::read_scene(folder_.path_of(camera)));
      response.set_header("Cross-Origin-Resource-Policy", "same-origin");
      response.set_content(json, "application/json");
    } catch (const sim::Error& error) {
      refuse(response, kRefused, error.what());
    }
  }

  void send_map(const std::string& run, httplib::Response& response) const {
    try {
      const std::string planes = folder_.path_of(run + "/precipitation.fits");
      if (planes.empty()) return refuse(response, kNotFound, "there is no such map");
      answer(response, studio_map(planes.substr(0, planes.rfind('/'))));
    } catch (const sim::Error& error) {
      refuse(response, kRefused, error.what());
    }
  }

  void tell_job(const httplib::Request& request, httplib::Response& response) {
    StudioJobState state;
    std::size_t from = 0;
    try {
      if (request.has_param("from")) from = std::stoul(request.get_param_value("from"));
    } catch (const std::exception&) {
      return refuse(response, kRefused, "from: not a number");
    }
    if (!jobs_.look(std::stoi(request.matches[1]), from, state))
      return refuse(response, kNotFound, "there is no such command");
    Json json = {{"words", state.words}, {"said", state.said}, {"end", state.end}, {"runs", state.runs}};
    if (!state.runs) {
      json["exit_code"] = state.exit_code;
      json["output"] = state.output;
    }
    answer(response, json);
  }

  /// Calls `work` with the request's JSON, and answers with the message of what is wrong.
  template <class Work>
  static void with_json(const httplib::Request& request, httplib::Response& response, const Work& work) {
    if (request.get_header_value("Content-Type") != "application/json")
      return refuse(response, kWrongType, "JSON is expected");
    if (request.body.size() > kMostJson) return refuse(response, kTooLarge, "that is too much");
    try {
      work(Json::parse(request.body));
    } catch (const Json::exception&) {
      refuse(response, kRefused, "this JSON says not what is asked for");
    } catch (const sim::Error& error) {
      refuse(response, kRefused, error.what());
    }
  }

  /// Writes a scene with its changed values as a new file.
  void save(const Json& asked, httplib::Response& response) const {
    SceneOptions options;
    options.file = folder_.path_of(asked.at("scene").get<std::string>());
    options.changes = texts(asked.at("changes"));
    const std::string text = sim::write_scene(moving_scene_of(options), "Made with vegard studio.");
    const std::string name = folder_.put(asked.at("to").get<std::string>(),
                                         [&](const auto& take) { return take(text.data(), text.size()); });
    answer(response, {{"name", name}});
  }

  void take(const httplib::Request& request, httplib::Response& response,
            const httplib::ContentReader& reader) const {
    if (request.get_header_value("Content-Type") != "application/octet-stream")
      return refuse(response, kWrongType, "the bytes of a file are expected");
    try {
      const std::string name = folder_.put(request.get_param_value("name"), [&](const auto& take) {
        return reader([&](const char* bytes, std::size_t count) { return take(bytes, count); });
      });
      answer(response, {{"name", name}});
    } catch (const sim::Error& error) {
      const bool is_too_large = response.status == kTooLarge;  // which the reader has said
      refuse(response, is_too_large ? kTooLarge : kRefused,
             is_too_large ? fmt::format("a file may have {} MB at most", kMostBytes >> 20) : error.what());
    }
  }

  const StudioFolder& folder_;
  StudioJobs& jobs_;
  const std::string secret_;
  httplib::Server server_;
  int port_ = 0;
  std::atomic<std::chrono::steady_clock::time_point> last_request_ = std::chrono::steady_clock::now();
  std::thread thread_;
};

StudioServer::StudioServer(const StudioFolder& folder, StudioJobs& jobs, int port)
    : routes_(std::make_unique<Routes>(folder, jobs, port)) {}
StudioServer::~StudioServer() = default;

std::string StudioServer::address() const { return routes_->address(); }

double StudioServer::idle_s() const { return routes_->idle_s(); }

}  // namespace vegard::apps
