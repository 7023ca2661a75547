#include "ofm/view/live_messages.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

namespace ofm {
namespace {

using nlohmann::json;

static_assert(std::endian::native == std::endian::little, "the page reads little-endian numbers");

/// As the page's matrices have them.
json MatrixOf(const RigidTransform& transform) {
  Eigen::Matrix4f matrix = Eigen::Matrix4f::Identity();
  matrix.topLeftCorner<3, 3>() = transform.RotationMatrix().cast<float>();
  matrix.topRightCorner<3, 1>() = transform.translation().cast<float>();
  return std::vector<float>(matrix.data(), matrix.data() + matrix.size());
}

template <class T>
void Append(std::string& bytes, T value) {
  char buffer[sizeof(T)];
  std::memcpy(buffer, &value, sizeof(T));
  bytes.append(buffer, sizeof(T));
}

std::string Begin(char kind) { return {kind, '\0', '\0', '\0'}; }

constexpr float kStep_m = 0.001F;
constexpr float kMax_m = 32;

}  // namespace

std::string_view NameOf(TrackingStatus status) {
  switch (status) {
    case TrackingStatus::kWaiting:
      return "waiting for a view with depth";
    case TrackingStatus::kInitialized:
      return "map begun";
    case TrackingStatus::kTracked:
      return "tracked";
    case TrackingStatus::kRelocalized:
      return "relocalised";
    case TrackingStatus::kReckoned:
      return "dead reckoning";
    case TrackingStatus::kLost:
      return "lost";
  }
  return "?";
}

std::string EncodeState(const LiveState& state) {
  json message = {{"kind", "state"},
                  {"frames_done", state.frames_done},
                  {"frames_per_s", state.frames_per_s},
                  {"status", NameOf(state.status)},
                  {"has_pose", HasPose(state.status)},
                  {"inliers", state.inliers},
                  {"keyframes", state.keyframes},
                  {"landmarks", state.landmarks},
                  {"masked_share", state.masked_share}};
  if (state.frames) message["frames"] = *state.frames;
  if (state.world_from_camera) message["world_from_camera"] = MatrixOf(*state.world_from_camera);
  return message.dump();
}

std::string EncodeKeyframes(const MapSnapshot& map) {
  const SubmapId submap = map.FindSubmap(map.latest_keyframe);
  json poses = json::array();
  map.keyframes.ForEach([&](const Keyframe& keyframe) {
    if (keyframe.submap != submap || !keyframe.frame_id.valid()) return;
    poses.push_back({keyframe.frame_id.value, MatrixOf(keyframe.camera_from_world.Inverse())});
  });
  return json{{"kind", "keyframes"}, {"poses", poses}}.dump();
}

std::string EncodeClasses(const std::vector<std::string>& class_names) {
  return json{{"kind", "classes"}, {"names", class_names}}.dump(-1, ' ', false,
                                                                json::error_handler_t::replace);
}

std::string EncodeEnd() { return json{{"kind", "end"}}.dump(); }

std::string EncodeImage(std::span<const unsigned char> jpeg) {
  std::string bytes = Begin('I');
  bytes.append(jpeg.begin(), jpeg.end());
  return bytes;
}

std::string EncodeCloud(FrameId frame, const std::vector<LabelledPoint>& points_in_camera) {
  std::vector<LabelledPoint> near;
  std::ranges::copy_if(points_in_camera, std::back_inserter(near), [](const LabelledPoint& point) {
    return point.position.cwiseAbs().maxCoeff() < kMax_m;
  });
  std::string bytes = Begin('C');
  Append(bytes, frame.value);
  Append(bytes, static_cast<std::uint32_t>(near.size()));
  for (const LabelledPoint& point : near) {
    for (const float place_m : point.position) {
      Append(bytes, static_cast<std::int16_t>(std::lround(place_m / kStep_m)));
    }
  }
  for (const LabelledPoint& point : near) {
    for (const std::uint8_t value : {point.color.r, point.color.g, point.color.b, point.class_id}) {
      Append(bytes, value);
    }
  }
  return bytes;
}

}  // namespace ofm
