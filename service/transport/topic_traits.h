// Which C type, generated from idl/bleed.idl, travels on which topic.
#pragma once

#include "idl/bleed.h"
#include "service/transport/names.h"

namespace bleedsim::transport {

/// Specialised for each topic type: `topic` and `descriptor()`.
template <class T>
struct TopicTraits;

template <>
struct TopicTraits<bleed_v1_Frame> {
  static constexpr Topic kTopic = Topic::frame;
  static const dds_topic_descriptor_t* descriptor() { return &bleed_v1_Frame_desc; }
};
template <>
struct TopicTraits<bleed_v1_FrameStats> {
  static constexpr Topic kTopic = Topic::frame_stats;
  static const dds_topic_descriptor_t* descriptor() { return &bleed_v1_FrameStats_desc; }
};
template <>
struct TopicTraits<bleed_v1_Scene> {
  static constexpr Topic kTopic = Topic::scene;
  static const dds_topic_descriptor_t* descriptor() { return &bleed_v1_Scene_desc; }
};
template <>
struct TopicTraits<bleed_v1_Status> {
  static constexpr Topic kTopic = Topic::status;
  static const dds_topic_descriptor_t* descriptor() { return &bleed_v1_Status_desc; }
};
template <>
struct TopicTraits<bleed_v1_Instrument> {
  static constexpr Topic kTopic = Topic::instrument;
  static const dds_topic_descriptor_t* descriptor() { return &bleed_v1_Instrument_desc; }
};
template <>
struct TopicTraits<bleed_v1_Request> {
  static constexpr Topic kTopic = Topic::request;
  static const dds_topic_descriptor_t* descriptor() { return &bleed_v1_Request_desc; }
};
template <>
struct TopicTraits<bleed_v1_Reply> {
  static constexpr Topic kTopic = Topic::reply;
  static const dds_topic_descriptor_t* descriptor() { return &bleed_v1_Reply_desc; }
};
template <>
struct TopicTraits<bleed_v1_Journal> {
  static constexpr Topic kTopic = Topic::journal;
  static const dds_topic_descriptor_t* descriptor() { return &bleed_v1_Journal_desc; }
};

}  // namespace bleedsim::transport
