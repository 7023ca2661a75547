#include "download.h"

#include <curl/curl.h>

#include <array>
#include <exception>
#include <memory>

#include "ofm/base/check.h"
#include "ofm/base/error.h"

namespace ofm {
namespace {

struct Transfer {
  const Download* download;
  std::exception_ptr failure;  // of `take`: an exception may not pass through C
};

std::size_t Write(char* bytes, std::size_t size, std::size_t count, void* user) {
  auto& transfer = *static_cast<Transfer*>(user);
  try {
    transfer.download->take({bytes, size * count});
    return size * count;
  } catch (...) {
    transfer.failure = std::current_exception();
    return 0;  // ends the transfer
  }
}

int Report(void* user, curl_off_t total, curl_off_t done, curl_off_t, curl_off_t) {
  const Download& download = *static_cast<Transfer*>(user)->download;
  if (download.stop.stop_requested()) return 1;  // ends the transfer
  if (download.progress && done > 0) {
    download.progress(static_cast<std::uint64_t>(done), static_cast<std::uint64_t>(total));
  }
  return 0;
}

}  // namespace

void Fetch(const Download& download) {
  OFM_CHECK(download.take != nullptr);
  curl_global_init(CURL_GLOBAL_DEFAULT);
  const std::unique_ptr<CURL, decltype(&curl_easy_cleanup)> curl(curl_easy_init(),
                                                                 curl_easy_cleanup);
  OFM_CHECK(curl != nullptr);
  Transfer transfer{&download, nullptr};
  std::array<char, CURL_ERROR_SIZE> reason{};
  curl_easy_setopt(curl.get(), CURLOPT_URL, download.address.c_str());
  curl_easy_setopt(curl.get(), CURLOPT_PROTOCOLS_STR, "http,https");
  curl_easy_setopt(curl.get(), CURLOPT_REDIR_PROTOCOLS_STR, "http,https");
  curl_easy_setopt(curl.get(), CURLOPT_FOLLOWLOCATION, 1L);
  curl_easy_setopt(curl.get(), CURLOPT_MAXREDIRS, 10L);
  curl_easy_setopt(curl.get(), CURLOPT_FAILONERROR, 1L);
  curl_easy_setopt(curl.get(), CURLOPT_CONNECTTIMEOUT, 30L);
  curl_easy_setopt(curl.get(), CURLOPT_LOW_SPEED_LIMIT, 100L);  // [bytes/s]
  curl_easy_setopt(curl.get(), CURLOPT_LOW_SPEED_TIME, 60L);
  curl_easy_setopt(curl.get(), CURLOPT_NOSIGNAL, 1L);
  curl_easy_setopt(curl.get(), CURLOPT_USERAGENT, "ofm-slam/" OFM_VERSION);
  curl_easy_setopt(curl.get(), CURLOPT_ERRORBUFFER, reason.data());
  curl_easy_setopt(curl.get(), CURLOPT_WRITEFUNCTION, Write);
  curl_easy_setopt(curl.get(), CURLOPT_WRITEDATA, &transfer);
  curl_easy_setopt(curl.get(), CURLOPT_NOPROGRESS, 0L);
  curl_easy_setopt(curl.get(), CURLOPT_XFERINFOFUNCTION, Report);
  curl_easy_setopt(curl.get(), CURLOPT_XFERINFODATA, &transfer);
  const CURLcode code = curl_easy_perform(curl.get());
  if (transfer.failure) std::rethrow_exception(transfer.failure);
  if (code == CURLE_ABORTED_BY_CALLBACK) throw Error(download.address + ": interrupted");
  if (code != CURLE_OK) {
    const std::string text = reason[0] != '\0' ? reason.data() : curl_easy_strerror(code);
    throw Error(download.address + ": cannot be fetched: " + text);
  }
}

}  // namespace ofm
