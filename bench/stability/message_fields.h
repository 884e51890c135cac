// Every number of a Protobuf message, found by reflection, to be replaced by bad ones.
#pragma once

#include <google/protobuf/message.h>

#include <functional>
#include <string>
#include <vector>

namespace lfd::bench {

// One number in a message.
struct NumberField {
  std::string road;                // "module 0: pinhole: k1"
  std::vector<std::string> words;  // one of which an error must have in it: the field's name, and its parent's
  // A copy of the message for every bad value of the field's type, with the value as text.
  struct Spoilt {
    std::string value;
    std::shared_ptr<google::protobuf::Message> message;
  };
  std::vector<Spoilt> spoilt;
};

// All fields that are numbers or enumerators, in messages that `message` has; of repeated ones with more than 16
// elements the first, the middle and the last.
std::vector<NumberField> number_fields(const google::protobuf::Message& message);

}  // namespace lfd::bench
