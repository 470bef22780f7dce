#include <filesystem>
#include <iostream>
#include <optional>
#include <regex>
#include <string>
#include <utility>

#include "DenseExport.h"
#include "ExportInput.h"
#include "common/CommandLine.h"
#include "common/KeptFiles.h"
#include "common/ProgressBar.h"
#include "common/SeveralOutputs.h"
#include "quadmap/base/OutputGroup.h"
#include "quadmap/dense/DenseCloud.h"
#include "quadmap/review/ContactSheet.h"
#include "quadmap/review/GlbFile.h"
#include "quadmap/review/KeyframePictures.h"
#include "quadmap/review/PageFile.h"
#include "quadmap/review/PictureAnnotation.h"
#include "quadmap/review/PlyFile.h"
#include "quadmap/review/SceneBuilder.h"
#include "quadmap/review/SceneRenderer.h"

namespace
{
using namespace quadmap;

/** The arguments of the program. */
struct Cli
{
  using Text = TCLAP::ValueArg<std::string>;

  cli::CommandLine line{
      "quadmap-export",
      "Writes a map in forms that people and other programs can look at. Of a folder it shows the "
      "objects, the trajectories and the coloured point cloud of the keyframes; of a map file the "
      "objects. No display is needed.",
      QUADMAP_VERSION};
  TCLAP::UnlabeledValueArg<std::string> input{
      "OUTDIR",
      "Folder quadmap-slam wrote, its objects.quadmap, or its objects.simplemap, which is mapped "
      "anew.",
      true,
      "",
      "OUTDIR|MAP",
      line.args()};
  cli::Example page{
      line, "quadmap-export home --html home.html",
      "Makes a page for any browser, with all images and boxes."};
  cli::Example pictures{
      line, "quadmap-export home --png home.png --top home_top.png",
      "Draws the map at an angle and from above, without a display."};
  cli::Group outputs{line, "What to write"};
  Text scene{"",     "scene",    "Scene for MRPT's SceneViewer3D (.3Dscene).", false, "",
             "FILE", line.args()};
  Text png{"", "png", "Picture at an angle from above.", false, "", "FILE", line.args()};
  Text top{"", "top", "Picture straight from above (.png).", false, "", "FILE", line.args()};
  Text ply{"",     "ply",      "Ellipsoids as triangles, and the point cloud.", false, "",
           "FILE", line.args()};
  Text sheet{"",     "sheet",    "Contact sheet: each object in its best image (.png).", false, "",
             "FILE", line.args()};
  Text glb{"",     "glb",      "Objects, trajectories and cloud as binary glTF.", false, "",
           "FILE", line.args()};
  Text json{"", "json", "The objects (form of objects.json).", false, "", "FILE", line.args()};
  Text html{"", "html", "Page for a browser, complete in itself.", false, "", "FILE", line.args()};
  Text frames{
      "",
      "frames",
      "Folder for a picture of each keyframe with its boxes, what was made of them, and the "
      "objects they were taken for, in the place of earlier ones; made when missing.",
      false,
      "",
      "DIR",
      line.args()};
  Text cloud{
      "",
      "cloud",
      "The room as a cloud of points with normals, fused from all keyframes (.pcd or .ply).",
      false,
      "",
      "FILE",
      line.args()};
  Text objectClouds{
      "",
      "object-clouds",
      "Folder for the points of each object, as ID_LABEL.pcd; made when missing.",
      false,
      "",
      "DIR",
      line.args()};
  Text config{"c",        "config", "Section [dense]: how --cloud and --object-clouds are made.",
              false,      "",       "FILE.ini",
              line.args()};
  cli::Group compared{line, "What to compare with"};
  Text truth{"",         "truth", "True objects, drawn in black. Needs --trajectory or --in-place.",
             false,      "",      "objects.gt.json",
             line.args()};
  Text trajectory{"",         "trajectory", "True trajectory, by which the truth is aligned.",
                  false,      "",           "groundtruth.tum",
                  line.args()};
  TCLAP::SwitchArg inPlace{"", "in-place", "The truth is in the map's frame already.", line.args()};
  Text compare{
      "",         "compare", "Second map to show beside this one in the page, in the same frame.",
      false,      "",        "OUTDIR|MAP",
      line.args()};
  cli::Group manner{line, "How"};
  Text three{
      "",         "three",      "Folder of three.js for --html (default that of libjs-three).",
      false,      kThreeFolder, "DIR",
      line.args()};
  Text size{"",    "size",     "Of the pictures [px] (default 1280x720).", false, "1280x720",
            "WxH", line.args()};
  TCLAP::SwitchArg noCloud{"", "no-cloud", "Leave out the point cloud.", line.args()};
};

PictureSize pictureSizeFrom(const std::string& text)
{
  std::smatch match;
  if (!std::regex_match(text, match, std::regex("([0-9]{1,4})x([0-9]{1,4})")))
    throw cli::UsageError("--size: expected WIDTHxHEIGHT, as 1280x720, got '" + text + "'");
  const auto number = [&](std::size_t i) { return static_cast<unsigned>(std::stoul(match[i])); };
  const PictureSize size{number(1), number(2)};
  if (!size.isValid())
    throw cli::UsageError("--size: sides must be 16 to 4096 pixels, got '" + text + "'");
  return size;
}

void requirePngName(TCLAP::ValueArg<std::string>& argument)
{
  if (argument.isSet() && std::filesystem::path(argument.getValue()).extension() != ".png")
    throw cli::UsageError("--" + argument.getName() + ": the name must end in .png");
}

/** The files that were asked for. */
cli::NamedOutputs outputsOf(Cli& cli)
{
  cli::NamedOutputs outputs;
  for (Cli::Text* output :
       {&cli.html, &cli.scene, &cli.png, &cli.top, &cli.ply, &cli.glb, &cli.sheet, &cli.json,
        &cli.cloud})
    if (output->isSet()) outputs.emplace_back("--" + output->getName(), output->getValue());
  return outputs;
}

/** \exception UsageError For an output that would replace what is read, would be taken for it, or
 * is another output, too. */
void checkOutputs(Cli& cli)
{
  const std::pair<Cli::Text*, const char*> endings[] = {
      { &cli.html,    ".html"},
      {&cli.scene, ".3Dscene"},
      {  &cli.ply,     ".ply"},
      {  &cli.glb,     ".glb"},
      { &cli.json,    ".json"}
  };
  for (const auto& [output, ending] : endings)
    if (output->isSet()) cli::requireNoOtherEnding(output->getName(), output->getValue(), ending);
  cli::KeptFiles kept;
  kept.add(cli.input.getValue());
  for (Cli::Text* input : {&cli.truth, &cli.trajectory, &cli.compare, &cli.config})
    if (input->isSet()) kept.add(input->getValue());
  const cli::NamedOutputs outputs = outputsOf(cli);
  for (const auto& [option, output] : outputs) kept.requireNone(option, output);
  cli::requireDifferentFiles(outputs);
}

void checkUsage(Cli& cli)
{
  pictureSizeFrom(cli.size.getValue());
  requirePngName(cli.png);
  requirePngName(cli.top);
  requirePngName(cli.sheet);
  if (cli.truth.isSet() && cli.trajectory.isSet() == cli.inPlace.getValue())
    throw cli::UsageError(
        "--truth: give either --trajectory, the true trajectory that aligns it with the map, or "
        "--in-place when it is in the map's frame");
  if (!cli.truth.isSet() && (cli.trajectory.isSet() || cli.inPlace.getValue()))
    throw cli::UsageError("--trajectory and --in-place belong to --truth");
  if (cli.compare.isSet() && (cli.truth.isSet() || !cli.html.isSet()))
    throw cli::UsageError("--compare: belongs to --html, and goes without --truth");
  if (cli.cloud.isSet() && !isCloudName(cli.cloud.getValue()))
    throw cli::UsageError("--cloud: the name must end in .pcd or .ply");
  if (cli.config.isSet() && !cli.cloud.isSet() && !cli.objectClouds.isSet())
    throw cli::UsageError("--config: belongs to --cloud and --object-clouds");
  checkOutputs(cli);
  for (const auto* output :
       {&cli.html, &cli.scene, &cli.png, &cli.top, &cli.ply, &cli.glb, &cli.sheet, &cli.json,
        &cli.frames, &cli.cloud, &cli.objectClouds})
    if (output->isSet()) return;
  throw cli::UsageError(
      "nothing to write: give --html, --scene, --png, --top, --ply, --glb, --sheet, --json, "
      "--frames, --cloud or --object-clouds");
}

/** What is written, and what is said of it when it is there. */
struct Output
{
  OutputGroup files;
  std::string text;
};

/** Runs a writer if its file was asked for. */
template <typename Write>
void writeIfSet(TCLAP::ValueArg<std::string>& argument, Output& output, Write&& write)
{
  if (!argument.isSet()) return;
  write(output.files.add(argument.getValue()));
  output.text += "wrote " + argument.getValue() + "\n";
}

/** The value of an argument, if it was given. */
std::optional<std::string> given(Cli::Text& argument)
{
  if (!argument.isSet()) return std::nullopt;
  return argument.getValue();
}

ExportInput inputOf(Cli& cli)
{
  ExportInput input;
  input.path = cli.input.getValue();
  input.truthPath = given(cli.truth);
  input.trajectoryPath = given(cli.trajectory);
  input.inPlace = cli.inPlace.getValue();
  const bool showsCloud = cli.html.isSet() || cli.scene.isSet() || cli.png.isSet() ||
                          cli.top.isSet() || cli.ply.isSet() || cli.glb.isSet() ||
                          cli.sheet.isSet();
  input.withCloud = showsCloud && !cli.noCloud.getValue();
  return input;
}

/** \exception std::runtime_error If there is no image for the sheet to show objects in. */
void requireImages(Cli& cli, const PageContent& page)
{
  if (page.keyframes.empty())
    throw std::runtime_error(
        cli.input.getValue() +
        ": --sheet needs images: a folder that quadmap-slam wrote, with map.simplemap, and no "
        "--no-cloud");
}

void writeFrames(Cli& cli, const std::vector<ObjectRecord>& objects, Output& output)
{
  if (!cli.frames.isSet()) return;
  if (!std::filesystem::is_directory(cli.input.getValue()))
    throw std::runtime_error(
        cli.input.getValue() + ": --frames needs a folder that quadmap-slam wrote");
  const std::string& folder = cli.frames.getValue();
  cli::ProgressBar bar;
  const auto count = writeKeyframePictures(
      cli.input.getValue(), objects, folder, output.files, [&](double share) { bar(share); });
  output.text += "wrote " + std::to_string(count) + " pictures into " + folder + "\n";
}

/** All that shows a scene. */
void writeScenes(Cli& cli, const SceneContent& content, Output& output)
{
  const PictureSize size = pictureSizeFrom(cli.size.getValue());
  writeFrames(cli, content.objects, output);
  output.text += writeDenseClouds(
      cli.input.getValue(), content.objects,
      {given(cli.cloud), given(cli.objectClouds), given(cli.config)}, output.files);
  const SceneBuilder builder;
  writeIfSet(cli.json, output, [&](const auto& path) { writeObjectsJson(path, content.objects); });
  writeIfSet(cli.ply, output, [&](const auto& path) { writePly(content, path); });
  writeIfSet(cli.glb, output, [&](const auto& path) { writeGlb(content, path); });
  writeIfSet(
      cli.scene, output, [&](const auto& path) { writeScene(*builder.scene(content), path); });
  if (!cli.png.isSet() && !cli.top.isSet()) return;
  SceneRenderer renderer(size);
  const auto picture = [&](const std::string& path, const RenderCamera& camera)
  {
    mrpt::img::CImage drawn = renderer.render(*builder.picture(content, camera, size), camera);
    annotatePicture(content, camera, drawn);
    writePicture(drawn, path);
  };
  writeIfSet(
      cli.png, output, [&](const auto& p) { picture(p, obliqueCamera(content, size.aspect())); });
  writeIfSet(
      cli.top, output, [&](const auto& p) { picture(p, cameraFromAbove(content, size.aspect())); });
}

void writeAll(Cli& cli, Output& output)
{
  const ExportInput input = inputOf(cli);
  if (!cli.html.isSet() && !cli.sheet.isSet())
    return writeScenes(cli, readExportInput(input), output);
  PageContent page = readPageInput(input, given(cli.compare));
  if (cli.sheet.isSet()) requireImages(cli, page);
  writeIfSet(
      cli.html, output, [&](const auto& path) { writePage(page, path, cli.three.getValue()); });
  writeIfSet(cli.sheet, output, [&](const auto& path) { writeContactSheet(page, path); });
  writeScenes(cli, page.scene, output);
}

void run(Cli& cli)
{
  checkUsage(cli);
  std::ostream& messages = cli::messagesBeside(outputsOf(cli));
  Output output;
  writeAll(cli, output);
  output.files.commit();
  messages << output.text;
}
}  // namespace

int main(int argc, char** argv)
{
  return cli::runMain(
      "quadmap-export",
      [&]
      {
        Cli cli;
        if (cli.line.parse(argc, argv)) run(cli);
      });
}
