"""check_page.py CHECK PAGE: looks at a page in a browser as a person does. Says what is wrong; 77: no browser."""
import os
import sys
import time

from browser import Browser, path_of_browser


def require(condition, text):
    if not condition:
        raise AssertionError(text)


def address_of(path, link=""):
    return "file://" + path + link


def pixel_of(page, object_id):
    """Where the middle of an object is drawn in the window."""
    return page.evaluate(
        f"(() => {{ const p = Page.view.pixelOf(new THREE.Vector3().fromArray(Page.objects.get('{object_id}').center));"
        "const b = document.getElementById('view').getBoundingClientRect(); return [b.left + p.x, b.top + p.y]; })()")


def check_links_between_table_and_view(path):
    with Browser(address_of(path)) as page:
        page.click_on("#objects tbody tr[data-id='2']")
        require(page.evaluate("Page.selected") == "2", "a click on a row selects its object")
        require(page.evaluate("document.querySelector('tr.selected').dataset.id") == "2", "the row is marked")
        require(page.evaluate("Page.shapes.drawn.get('2').body.material.opacity") > 0.7, "the body is marked")
        page.click(*pixel_of(page, "3"))
        require(page.evaluate("Page.selected") == "3", "a click on a body selects its object")
        require(page.evaluate("document.querySelector('tr.selected').dataset.id") == "3", "and its row")
        require(page.evaluate("document.querySelector('#facts h2').textContent").endswith(" 3"), "and its facts")


def check_doubtful_objects_hide(path):
    with Browser(address_of(path, "#h=doubtful")) as page:
        shown = "Page.shapes.drawn.get('{}').body.visible"
        doubtful = page.evaluate("Array.from(Page.objects.values()).filter(Page.isDoubtful).map((o) => o.id)")
        sure = page.evaluate("Array.from(Page.objects.values()).filter((o) => !Page.isDoubtful(o)).map((o) => o.id)")
        require(doubtful and sure, "the test's map has doubtful objects and others")
        require(not any(page.evaluate(shown.format(i)) for i in doubtful), "the link hides doubtful objects")
        require(all(page.evaluate(shown.format(i)) for i in sure), "and no others")
        page.evaluate(f"Page.select('{doubtful[0]}')")
        require(page.evaluate(shown.format(doubtful[0])), "a selected one is shown")
        page.evaluate("Page.select(null), document.querySelector('#layers input[name=doubtful]').click()")
        require(all(page.evaluate(shown.format(i)) for i in doubtful + sure), "the layer brings them back")


def check_labels_stay_text(path):
    with Browser(address_of(path)) as page:
        page.click_on("#objects tbody tr[data-id='1']")
        for tab in ("object", "keyframes", "compare", "objects"):
            page.evaluate(f"Page.showTab('{tab}')")
        label = page.evaluate("Page.objects.get('1').label")
        require("<script>" in label and "<img" in label, "the test's label holds markup: " + label)
        require(page.evaluate("document.querySelector('tr[data-id=\"1\"]').textContent.includes(Page.objects.get('1').label)"),
                "the table shows the label as it is")
        require(page.evaluate("document.querySelectorAll('img').length") == 0, "no element came from a label")
        require(page.evaluate("typeof window.attacked") == "undefined", "no script came from a label")


def check_keyframes(path):
    with Browser(address_of(path, "#k=1")) as page:
        require(page.evaluate("Page.keyframe") == 1, "the link names the keyframe")
        page.evaluate("Page.showTab('keyframes')")
        page.wait("document.getElementById('image').getContext('2d').getImageData(2, 2, 1, 1).data[0] > 150")
        text = page.evaluate("document.getElementById('boxes').textContent")
        for part in ("complete", "the cuboid fits", "rejected", "too few points", "object 2", "no object"):
            require(part in text, f"the list of boxes lacks '{part}': {text}")
        when = page.evaluate("document.getElementById('frame-text').textContent")
        require("1.0 s" in when and "1970" not in when, f"a clock that began at zero tells no date: {when}")
        page.evaluate("Page.keyframe = -1, Page.data.keyframes[1].time = 1600000000, Page.keyframes.show(1)")
        when = page.evaluate("document.getElementById('frame-text').textContent")
        require("(2020-09-13 12:26:40.000Z)" in when, f"others tell it: {when}")
        ground = page.evaluate("Array.from(document.getElementById('image').getContext('2d').getImageData(11, 9, 1, 1).data)")
        require(max(ground[:3]) < 110, f"the name of a box stands on a dark ground: {ground}")
        page.click_on("#boxes button")
        require(page.evaluate("Page.selected") == "2", "a box's button selects its object")
        page.click_on("#after")
        require(page.evaluate("Page.keyframe") == 2, "the button goes on")


def check_link_keeps_the_view(path):
    with Browser(address_of(path)) as page:
        page.evaluate("Page.select('3')")
        page.click_on("#top")
        page.wait("!Page.view.moving && location.hash.includes('o=3')")
        link, seen = page.evaluate("location.hash"), page.evaluate("Page.view.camera.position.toArray()")
    with Browser(address_of(path, link)) as page:
        again = page.evaluate("Page.view.camera.position.toArray()")
        require(max(abs(a - b) for a, b in zip(seen, again)) < 0.01, f"{seen} became {again}")
        require(page.evaluate("Page.selected") == "3", "the link keeps what is selected")


def check_measures(path):
    with Browser(address_of(path)) as page:
        page.click_on("#measure")
        page.click(*pixel_of(page, "2"))
        page.click(*pixel_of(page, "3"))
        require(page.evaluate("Page.overlay.measured.length") == 2, "two clicks, two points")
        away = page.evaluate("Page.overlay.distance()")
        require(1.0 < away < 4.0, f"distance between the surfaces: {away}")
        require(f"{away:.3f} m" in page.evaluate("document.getElementById('note').textContent"), "it is told")


def check_compares(path):
    with Browser(address_of(path)) as page:
        text = page.evaluate("document.getElementById('compare').textContent")
        for part in ("1 found", "1 phantom", "1 missed", "phantom: refrigerator 3", "missed: bed 9"):
            require(part in text, f"lacks '{part}': {text}")
        require(page.evaluate("Page.shapes.layers.compared.children.length") == 2, "all true objects are drawn")


def check_phone_and_themes(path):
    with Browser(address_of(path), 390, 800) as page:
        box = page.evaluate("(() => { const b = document.querySelector('aside').getBoundingClientRect(); return [b.left, b.width]; })()")
        require(box == [0, 390], f"the panel takes the whole width: {box}")
        require(page.evaluate("document.documentElement.scrollWidth") <= 390, "nothing sticks out")
        before = page.evaluate("Page.themeColor('--back')")
        page.click_on("#theme")
        require(page.evaluate("Page.themeColor('--back')") != before, "the theme changes")
        schemes = [page.evaluate(f"(document.documentElement.dataset.theme = '{theme}', getComputedStyle(document.body).colorScheme)")
                   for theme in ("dark", "light")]
        require(schemes == ["dark", "light"], f"scroll bars and fields follow the theme: {schemes}")


def check_table_fits(path):
    """No sideways scrolling, not even beside the bar that many rows need, nor with a long label."""
    for width, height in ((1280, 800), (800, 600), (390, 800)):
        with Browser(address_of(path), width, height) as page:
            page.evaluate("document.querySelector('#objects .scroll').style.maxHeight = '40px'")
            page.evaluate("document.querySelector('#objects td:nth-child(2)').append('w'.repeat(80))")
            wide, room = page.evaluate("(() => { const e = document.querySelector('#objects .scroll'); return [e.scrollWidth, e.clientWidth]; })()")
            require(wide <= room, f"the table takes {wide} of {room} pixels in a window of {width}")
            shown = page.evaluate("Array.from(document.querySelectorAll('#objects th')).filter((e) => e.offsetWidth).map((e) => e.textContent)")
            extra = page.evaluate("Array.from(document.querySelectorAll('#objects .extra')).filter((e) => e.offsetWidth).length")
            if width == 1280:
                require(len(shown) == 9 and extra > 0, f"all columns are shown: {shown}")
            else:
                require({"label", "size [m]", "exists", "verdict"} < set(shown), f"its columns: {shown}")
                require(extra == 0, f"{extra} cells of the other columns are shown in a window of {width}")


def type_into(page, selector, text):
    page.evaluate(f"(() => {{ const e = document.querySelector({selector!r}); e.value = {text!r};"
                  "e.dispatchEvent(new Event('change')); })()")


def saved_file(page, button, folder, name):
    page.call("Browser.setDownloadBehavior", behavior="allow", downloadPath=folder)
    page.click_on(button)
    path = os.path.join(folder, name)
    deadline = time.monotonic() + 20
    while not os.path.exists(path) or not os.path.getsize(path):
        require(time.monotonic() < deadline, f"{name} is not saved")
        time.sleep(0.05)
    return path


def check_edits(path):
    """Relabels object 1, types a place for 2, drags 3, and saves both files beside the page."""
    folder = os.path.dirname(path)
    with Browser(address_of(path)) as page:
        page.evaluate("Page.showTab('object')")
        page.evaluate("Page.select('1')")
        type_into(page, "#new-label", "bench")
        page.click_on("#relabel")
        require(page.evaluate("document.querySelector('tr[data-id=\"1\"]').textContent").find("bench") > 0, "the table follows")
        page.evaluate("Page.select('2')")
        type_into(page, "#edit input[type=number]", "-1.25")
        require(page.evaluate("Page.objects.get('2').center[0]") == -1.25, "a typed number places the object")
        page.evaluate("Page.select('3')")
        page.click_on("#drag")
        before = page.evaluate("Page.objects.get('3').center")
        x, y = pixel_of(page, "3")
        page.drag((x, y), (x + 40, y))
        after = page.evaluate("Page.objects.get('3').center")
        moved = [b - a for a, b in zip(before, after)]
        require(abs(moved[0]) + abs(moved[1]) > 0.05 and abs(moved[2]) < 1e-9, f"dragged over the floor: {moved}")
        require(page.evaluate("Page.selected") == "3", "a drag is no click")
        page.evaluate("Page.editing.add({op: 'remove', id: '1'})")
        require(page.evaluate("Page.objects.size") == 2, "removed")
        page.click_on("#undo")
        require(page.evaluate("Page.objects.get('1').label") == "bench", "taken back, and the rest is as it was")
        saved_file(page, "#save-edits", folder, "edits.json")
        saved_file(page, "#save-truth", folder, "objects.gt.json")


def check_handles(path):
    with Browser(address_of(path)) as page:
        page.evaluate("Page.showTab('object')")
        page.evaluate("Page.select('3')")
        page.click_on("#drag")
        size, yaw = page.evaluate("Page.objects.get('3').size"), page.evaluate("Page.objects.get('3').yaw")
        top = page.evaluate("(() => { const o = Page.objects.get('3'), v = new THREE.Vector3().fromArray(o.center);"
                            "v.z += o.size[2] / 2; const p = Page.view.pixelOf(v);"
                            "const b = document.getElementById('view').getBoundingClientRect(); return [b.left + p.x, b.top + p.y]; })()")
        low = page.evaluate("(() => { const o = Page.objects.get('3'); return o.center[2] - o.size[2] / 2; })()")
        page.drag(top, (top[0], top[1] - 30))
        now = page.evaluate("Page.objects.get('3').size")
        require(now[2] > size[2] + 0.05 and now[:2] == size[:2], f"the top face was dragged: {size} to {now}")
        again = page.evaluate("(() => { const o = Page.objects.get('3'); return o.center[2] - o.size[2] / 2; })()")
        require(abs(low - again) < 1e-9, "the bottom stays")
        require(page.evaluate("Page.objects.get('3').yaw") == yaw, "so does the heading")
        page.evaluate("Page.select('2')")
        page.evaluate("document.getElementById('absorbed').value = '3'")
        page.click_on("#merge")
        require(page.evaluate("Page.objects.size") == 2, "merged")
        require(page.evaluate("JSON.parse(Page.save.editList()).edits.pop()") == {"op": "merge", "keep": 2, "absorb": 3}, "and listed")


def check_rests(path):
    with Browser(address_of(path)) as page:
        page.wait("!Page.view.moving")
        time.sleep(0.5)
        frames = page.evaluate("Page.view.frames")
        time.sleep(1)
        require(page.evaluate("Page.view.frames") == frames, "nothing is drawn while nothing changes")
        require(page.evaluate("Page.cloud.points.geometry.drawRange.count") == page.evaluate("Page.data.cloud.points"),
                "at rest all points are drawn")
        corners = "Page.shapes.drawn.get('2').body.geometry.vertices.length"
        fine = page.evaluate(corners)
        page.evaluate(f"window.least = {fine}, Page.view.afterDraw.push(() => {{ window.least = Math.min(window.least, {corners}); }})")
        page.evaluate("Page.view.move()")
        if page.evaluate("Page.view.bySoftware"):  # moves until a frame is drawn meanwhile, which may take long on a busy machine
            page.wait(f"(Page.view.move(), window.least < {fine / 2})")
        page.wait(f"!Page.view.moving && {corners} === {fine}")


def frames_per_second(page, seconds):
    frames, start, i = page.evaluate("Page.view.frames"), time.monotonic(), 0
    page.mouse("mouseMoved", 100, 300, 0)
    page.mouse("mousePressed", 100, 300)
    while time.monotonic() < start + seconds:
        i += 1
        page.mouse("mouseMoved", 100 + i % 200, 300 + i % 70)
    rate = (page.evaluate("Page.view.frames") - frames) / (time.monotonic() - start)
    page.mouse("mouseReleased", 100, 300, 0)
    return rate


def check_speed(path):
    """The view of a large cloud moves. How fast depends on the machine and is told, not judged."""
    with Browser(address_of(path)) as page:
        rate = frames_per_second(page, 4)
        print(f"frames per second: {rate:.1f}")
        require(rate > 0, "nothing was drawn while the view moved")


def main():
    name, path = sys.argv[1:]
    if not path_of_browser():
        return 77
    kept = []
    original = Browser.close

    def close(self):  # what every check has in common
        kept.append((self.errors, self.requests))
        original(self)

    Browser.close = close
    globals()["check_" + name](path)
    for errors, requests in kept:
        require(not errors, "the console has errors: " + "; ".join(errors))
        outside = [r for r in requests if not r.startswith(("file://", "data:", "blob:"))]
        require(not outside, f"the page asked for {outside}")
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except (AssertionError, RuntimeError, TimeoutError) as failure:
        print(failure, file=sys.stderr)
        sys.exit(1)
