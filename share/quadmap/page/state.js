"use strict";
// What the scripts of the page share: the data, what is selected, and who wants to know of changes.
// Text of the data comes from files that nobody vouches for: it is only ever set as textContent.
const Page = {
  data: JSON.parse(document.getElementById("data").textContent),
  objects: new Map(),   // by id, as edited so far
  selected: null,       // id
  keyframe: -1,         // index
  listeners: {},

  on(event, listener) { (this.listeners[event] = this.listeners[event] || []).push(listener); },
  emit(event, value) { for (const listener of this.listeners[event] || []) listener(value); },

  byId(id) { return document.getElementById(id); },

  // An element with a class and a text; `parent` gets it.
  element(tag, parent, text, className) {
    const made = document.createElement(tag);
    if (text !== undefined && text !== null) made.textContent = text;
    if (className) made.className = className;
    if (parent) parent.appendChild(made);
    return made;
  },

  button(parent, text, action) {
    const made = this.element("button", parent, text);
    made.type = "button";
    made.addEventListener("click", action);
    return made;
  },

  cssColor(rgb) { return "rgb(" + rgb.join(",") + ")"; },
  themeColor(name) { return getComputedStyle(document.documentElement).getPropertyValue(name).trim(); },
  nameOf(object) { return object.label + " " + object.id; },
  note(text) { this.byId("note").textContent = text; },

  // Selects an object, or none (null).
  select(id) {
    if (id !== null && !this.objects.has(id)) id = null;
    if (id === this.selected) return;
    this.selected = id;
    this.emit("select", id);
  },

  // [s since 1970] as seconds after the first keyframe, or as a date.
  timeText(time) {
    if (time === null) return "";
    const first = this.data.keyframes[0];
    return (!first && this.dateText(time)) || (time - (first ? first.time : 0)).toFixed(1) + " s";
  },
  // Empty when the clock of the recording began at zero, or is beyond the calendar.
  dateText(time) {
    const date = new Date(1000 * time);
    return isNaN(date) || date.getUTCFullYear() < 1980 ? "" : date.toISOString().replace("T", " ");
  },

  // Distance of a centre from the truth that one would expect [m]; null when nothing is known.
  centreSigma(object) { return object.sigma && Math.hypot(object.sigma[0], object.sigma[1], object.sigma[2]); },
  // Not certain enough, or not confirmed at all.
  isDoubtful(object) { return !object.confirmed || (object.existence !== null && object.existence < Page.data.sureExistence); },

  // The objects as the map has them. The quaternions of the file are rounded.
  restore() {
    this.objects = new Map(this.data.objects.map(function (original) {
      const object = JSON.parse(JSON.stringify(original)), length = Math.hypot(...object.pose.slice(3));
      for (let i = 3; i < 7; ++i) object.pose[i] /= length;
      return [object.id, object];
    }));
  },
};
Page.restore();
