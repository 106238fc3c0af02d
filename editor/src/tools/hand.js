// Moves the paper; so do the space bar with any tool, the wheel, and two fingers.

/** @type {import("./tool.js").Tool} */
export const hand = {
  id: "hand",
  label: "Pan",
  key: "h",
  icon: "M8 12V6.5a1.5 1.5 0 0 1 3 0V11m0-.5V5a1.5 1.5 0 0 1 3 0v6m0-.5V6.5a1.5 1.5 0 0 1 3 0V14c0 4-2 7-6 7-3 0-4.500-1.500-6.500-5L4.500 13.500c-.5-1 .8-2 1.700-1.200L8 14",
  hint: "Drag to move the paper. The space bar does this with any tool; the wheel zooms with Ctrl.",

  hover: () => "grab",

  press({ stage }, from) {
    let last = from.screen;
    return {
      move({ screen }) {
        stage.viewport.pan(screen.x - last.x, screen.y - last.y);
        last = screen;
        stage.invalidate();
      },
    };
  },
};
