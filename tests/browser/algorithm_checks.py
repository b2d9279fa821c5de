"""What both kinds of page have to show of a document of the algorithm (fake_server.account), step by step."""

import numpy as np


def near(image, at, colour, reach=4) -> bool:
    """Whether a pixel near a place has a colour, nearly."""
    x, y = round(at["x"]), round(at["y"])
    part = image[max(0, y - reach):y + reach + 1, max(0, x - reach):x + reach + 1]
    return bool((np.abs(part - np.array(colour)).max(axis=2) < 40).any())


BLUE, ORANGE, ACCENT, GREEN, CRIMSON, PURPLE = (0, 114, 178), (196, 127, 0), (213, 94, 0), (0, 132, 95), (176, 0, 58), (163, 71, 138)


def check_steps(test, page, picture, first_place) -> None:
    """`picture` gives the scene's pixels; first_place is where body 0 stands when the frame begins."""
    def on_screen(point):
        return page.js(f"onScreen({list(point)})")

    def expect(image, points):
        for point, colour in points:
            test.assertTrue(near(image, on_screen(point), colour), f"{point} is not drawn in {colour}")

    page.js("Object.assign(camera, { target: [0.3, 0.8, 0.6], distance: 13, yaw: -0.9, pitch: 0.35 }); algorithm.camera = null; redraw()")  # all of it is in sight
    told = page.js("viewer.algorithm()")
    test.assertEqual((told["open"], told["steps"], told["at"]), (True, 4, 0))
    test.assertTrue(page.js("document.getElementById('stepText').textContent").startswith("Advance 1: the gap is at least 0.4 m"))
    test.assertGreaterEqual(page.js("parseFloat(getComputedStyle(document.getElementById('stepText')).fontSize)"), 16)
    test.assertEqual(page.js("[...document.querySelectorAll('#parts b')].map(e => e.textContent)"), ["1", "2", "3"])
    # Its pose is applied; points, lines and a chart are there; labels cover no other.
    image = picture()
    np.testing.assert_allclose(page.js("viewer.algorithm().positions[0]"), (-0.5, -1, 1.5), atol=1e-6)
    expect(image, [((-1.0, -0.9, 0.5), BLUE), ((1.0, -0.6, 0.5), ORANGE), ((0.0, -0.75, 0.5), ACCENT), ((-0.5, -0.825, 0.5), ACCENT)])
    boxes = page.js("""(() => { const boxes = [], plain = CanvasRenderingContext2D.prototype.roundRect;
        CanvasRenderingContext2D.prototype.roundRect = function (x, y, w, h) { boxes.push([x, y, x + w, y + h]); plain.apply(this, arguments); };
        drawOverlay(); CanvasRenderingContext2D.prototype.roundRect = plain; return boxes; })()""")
    test.assertEqual(len(boxes), 3)
    for k, a in enumerate(boxes):
        for b in boxes[:k]:
            test.assertFalse(a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3], "labels overlap")
    words = page.js("[...document.querySelectorAll('#stepChart svg text')].map(e => e.textContent)")
    for word in ("time of the frame [s]", "gap [m]", "0.4", "advance 2"):
        test.assertIn(word, words)
    test.assertEqual(page.js("document.querySelectorAll('#stepChart path').length"), 2)
    test.assertEqual(page.js("document.querySelectorAll('#stepBars svg').length"), 0)
    # The next step: its marks instead; the body is back.
    page.press("]")
    image = picture()
    np.testing.assert_allclose(page.js("viewer.algorithm().positions[0]"), first_place, atol=1e-5)
    expect(image, [((2.3, -0.5, 0.02), GREEN), ((1.5, -0.5, 1.0), PURPLE)])
    test.assertFalse(near(image, on_screen((-0.5, -0.825, 0.5)), ACCENT))
    page.press("]")  # on to the next part
    test.assertEqual(page.js("document.querySelector('#parts [aria-current=true] b').textContent"), "2")
    image = picture()
    expect(image, [((0.0, 3.0, 0.2), CRIMSON)])
    inside, beside = on_screen((0.15, 1.2, 0.5)), on_screen((-0.6, 0.2, 2.6))
    mesh = image[round(inside["y"]), round(inside["x"])] - image[round(beside["y"]), round(beside["x"])]
    test.assertGreater(mesh[2] - mesh[0], 40, "the hull shines blue")
    page.press("]")
    page.press("]")  # there is no further
    page.settle()
    test.assertEqual(page.js("viewer.algorithm().at"), 3)
    bars = page.js("[...document.querySelectorAll('#stepBars rect')].map(e => [+e.getAttribute('x'), +e.getAttribute('width')])")
    test.assertEqual(len(bars), 4)
    test.assertAlmostEqual(bars[0][1] / bars[1][1], 1.25 / 0.4, places=2)
    test.assertAlmostEqual(bars[1][0] + bars[1][1], bars[0][0], places=2, msg="negative ones go to the left of zero")
    words = page.js("[...document.querySelectorAll('#stepBars text, #stepBars .chartName')].map(e => e.textContent)")
    for word in ("impulses after this pivot [N s]", "contact 1", "-0.4, must not pull"):
        test.assertIn(word, words)
    test.assertIn("1e-8", page.js("[...document.querySelectorAll('#stepChart .tick')].map(e => e.textContent)"))
    # Nothing in the panel sticks out of it, or covers its neighbour.
    wide = page.js("document.getElementById('account').clientWidth")
    test.assertLessEqual(page.js("document.getElementById('account').scrollWidth"), wide)
    # The eye comes near where what is drawn is small, nearer by a key, and goes back at the end.
    page.js("Object.assign(camera, { distance: 200 }); algorithm.camera = null")
    page.press("[")
    page.settle()
    near_by = page.js("camera.distance")
    test.assertTrue(10 < near_by < 60, near_by)
    page.press("f")
    page.settle()
    test.assertLess(page.js("camera.distance"), 0.8 * near_by)
    page.press("Escape")
    page.settle()
    test.assertAlmostEqual(page.js("camera.distance"), 200)
    test.assertFalse(page.js("viewer.algorithm().open"))
    test.assertEqual(page.js("document.getElementById('account').offsetParent"), None)
    np.testing.assert_allclose(page.js("viewer.state().positions[0]"), first_place, atol=1e-5)
