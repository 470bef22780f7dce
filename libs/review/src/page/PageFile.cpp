#include "quadmap/review/PageFile.h"

#include <array>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <vector>

#include "page/Base64.h"
#include "page/PageData.h"
#include "quadmap/base/InputFile.h"
#include "quadmap/base/OutputFile.h"
#include "quadmap/base/Sha256.h"
#include "quadmap/base/ShareFiles.h"

namespace quadmap
{
namespace
{
/** In this order: each uses those before it. */
constexpr std::array kOwnScripts = {
    "state.js",     "view.js",    "shapes.js",  "cloud.js", "compare.js", "overlay.js", "table.js",
    "keyframes.js", "details.js", "editing.js", "drag.js",  "save.js",    "main.js"};
constexpr std::array kThreeScripts = {"three.min.js", "examples/js/controls/OrbitControls.js"};
constexpr const char* kThreeNotice =
    "three.js, https://threejs.org, Copyright 2010-2019 three.js authors, MIT licence";

std::string readText(const std::string& path, const std::string& advice = {})
{
  requireNoDevice(path);
  std::ifstream file(path, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (!file || text.empty()) throw std::runtime_error(path + ": cannot be read" + advice);
  return text;
}

std::vector<std::string> readScripts(const std::string& threeFolder)
{
  std::vector<std::string> scripts;
  for (const char* name : kThreeScripts)
  {
    const std::string path = threeFolder + "/" + name;
    scripts.push_back(safeScript(
        readText(
            path,
            "; a page needs three.js: install the package libjs-three, or name its folder "
            "with --three"),
        path));
  }
  for (const char* name : kOwnScripts)
    scripts.push_back(safeScript(readText(findShareFile(std::string("page/") + name)), name));
  return scripts;
}

/** The name of a script or style in a content security policy. */
std::string policyName(const std::string& text) { return " 'sha256-" + base64(sha256(text)) + "'"; }

/** Nothing is loaded from anywhere, and no script runs but these. */
std::string policyOf(const std::vector<std::string>& scripts, const std::string& style)
{
  std::string policy = "default-src 'none'; base-uri 'none'; form-action 'none'; img-src data:";
  policy += "; style-src" + policyName(style) + "; script-src";
  for (const std::string& script : scripts) policy += policyName(script);
  return policy;
}

/** A block of data, which browsers do not run. */
std::string dataBlock(const std::string& id, const std::string& type, const std::string& text)
{
  return "<script id=\"" + id + "\" type=\"" + type + "\">" + text + "</script>\n";
}

}  // namespace

void writePage(const PageContent& content, const std::string& path, const std::string& threeFolder)
{
  const std::vector<std::string> scripts = readScripts(threeFolder);
  const std::string style = readText(findShareFile("page/page.css"));
  std::string page = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n";
  page += "<meta http-equiv=\"Content-Security-Policy\" content=\"" + policyOf(scripts, style) +
          "\">\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n" +
          "<meta name=\"referrer\" content=\"no-referrer\">\n<title>quadmap</title>\n<style>" +
          style + "</style>\n</head>\n<body>\n" + readText(findShareFile("page/body.html"));
  page += dataBlock("data", "application/json", pageJson(content));
  page += dataBlock("cloud-data", "text/plain", base64(pageCloud(content.scene.cloud)));
  page += "<!-- " + std::string(kThreeNotice) + " -->\n";
  for (const std::string& script : scripts) page += "<script>" + script + "</script>\n";
  writeTextFile(path, page + "</body>\n</html>\n");
}

}  // namespace quadmap
