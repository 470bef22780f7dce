#pragma once

#include <mrpt/poses/CPose3D.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "quadmap/geometry/ImageBox.h"
#include "quadmap/obs/ObjectList.h"
#include "quadmap/review/SceneContent.h"

namespace quadmap
{
/** A row of the page's table of objects. */
struct PageObject
{
  ObjectRecord record;
  bool confirmed = true;  //!< Has enough evidence to be reported
  unsigned misses = 0;    //!< Frames that should have shown it and did not
};

/** A detector's box, and what became of it. */
struct PageBox
{
  std::string label, kind, reason;  //!< Kind and reason of the measurement
  double score = 1;                 //!< In [0, 1]
  ImageBox box;                     //!< In pixels of the camera's image
  std::optional<unsigned> object;   //!< The object it was taken for
};

/** One image of a keyframe. */
struct PageKeyframe
{
  double time = 0;  //!< [s since 1970]
  std::string sensor;
  CameraPose camera;
  unsigned width = 0, height = 0;  //!< Of the camera's image, which the boxes refer to [px]
  std::string jpeg;                //!< The image, perhaps reduced; empty where there is none
  std::vector<PageBox> boxes;
};

/** What a page shows. All poses and objects are in the frame of the map. */
struct PageContent
{
  std::string title;
  std::string mapSha256;            //!< Of the map's file, for edit lists: hexadecimal digits
  SceneContent scene;               //!< Trajectories and cloud; its objects are not shown
  std::vector<PageObject> objects;  //!< Of the map, confirmed or not
  std::vector<std::string> labels;  //!< Names offered when an object is labelled anew
  std::vector<PageKeyframe> keyframes;
  std::string comparedName;      //!< What the map is compared with; empty: with nothing
  bool comparedIsTruth = false;  //!< Else it is a second map
  std::vector<PageObject> compared;
};

}  // namespace quadmap
