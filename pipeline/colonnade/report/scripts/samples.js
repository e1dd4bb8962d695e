// What the page's data file holds, unpacked: series as float32, and the clocks that they are on.
"use strict";
const colonnade = {};

// Undo report/interactive/panels.py: inflate, join the planes of bytes, unfold the sign, add up the differences.
colonnade.unpack = async function (given) {
  const letters = atob(given.samples);
  const packed = new Uint8Array(letters.length);
  for (let i = 0; i < packed.length; i += 1) packed[i] = letters.charCodeAt(i);
  const inflated = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  const bytes = new Uint8Array(await new Response(inflated).arrayBuffer());
  let start = 0;
  return given.series.map(({ count, step, order, gaps }) => {
    const values = new Float32Array(count);
    let level = 0;
    let slope = 0;
    for (let i = 0; i < count; i += 1) {
      let folded = 0;
      for (let plane = 0; plane < given.planes; plane += 1) folded |= bytes[start + plane * count + i] << (8 * plane);
      const difference = (folded >>> 1) ^ -(folded & 1);
      slope = order === 2 ? slope + difference : difference;
      level += slope;
      values[i] = level * step;
    }
    start += given.planes * count;
    for (const [first, last] of gaps) values.fill(NaN, first, last);
    return values;
  });
};

// The times of a series: even ones, or even ones with what each is from them.
colonnade.Clock = class {
  constructor(given, series) {
    Object.assign(this, given);
    this.uneven = given.uneven === undefined ? null : series[given.uneven];
    this.end = this.at(this.count - 1);
  }

  at(index) {
    return this.start + this.interval * index + (this.uneven ? this.uneven[index] : 0);
  }

  // First sample at a time or after it; `count` if all are before it.
  from(time) {
    if (!this.uneven) return Math.min(Math.max(Math.ceil((time - this.start) / this.interval), 0), this.count);
    let [before, found] = [-1, this.count];
    while (found - before > 1) {
      const middle = (before + found) >> 1;
      if (this.at(middle) < time) before = middle;
      else found = middle;
    }
    return found;
  }

  // Sample next to a time; -1 if the series has none there.
  nearest(time) {
    if (time < this.start - this.interval || time > this.end + this.interval) return -1;
    const after = Math.min(this.from(time), this.count - 1);
    return after > 0 && time - this.at(after - 1) < this.at(after) - time ? after - 1 : after;
  }
};

// Series and clocks of the page, unpacked when they are first asked for.
colonnade.samples = function () {
  const { given } = colonnade;
  colonnade.unpacked ||= colonnade.unpack(given).then((series) => ({ series, clocks: given.clocks.map((clock) => new colonnade.Clock(clock, series)) }));
  return colonnade.unpacked;
};

// Parts of a view, one a pixel, as numbers of samples; a view of few samples has one part a sample.
function* parts(clock, from, to, pixels) {
  const first = Math.max(clock.from(from) - 1, 0);
  const last = Math.min(clock.from(to) + 1, clock.count);
  const many = last - first > 4 * pixels;
  const number = many ? pixels : last - first;
  for (let k = 0; k < number; k += 1) {
    yield many
      ? [first + Math.floor((k * (last - first)) / pixels), first + Math.floor(((k + 1) * (last - first)) / pixels)]
      : [first + k, first + k + 1];
  }
}

// Samples with the lowest and the highest value of a part; null of a part without values.
function extremes(values, first, last) {
  let low = -1;
  let high = -1;
  for (let i = first; i < last; i += 1) {
    if (values[i] === values[i]) {
      if (low < 0 || values[i] < values[low]) low = i;
      if (high < 0 || values[i] > values[high]) high = i;
    }
  }
  return low < 0 ? null : [low, high];
}

// A line as it is drawn: the lowest and the highest value a pixel, and each sample where there are few.
colonnade.thinned = function (clock, values, from, to, pixels) {
  const x = [];
  const y = [];
  for (const [first, last] of parts(clock, from, to, pixels)) {
    const found = extremes(values, first, last);
    if (!found) {
      x.push(clock.at(first));
      y.push(NaN);
      continue;
    }
    for (const index of found[0] === found[1] ? [found[0]] : found.sort((one, other) => one - other)) {
      x.push(clock.at(index));
      y.push(values[index]);
    }
  }
  return { x: Float64Array.from(x), y: Float64Array.from(y) };
};

// A band as it is drawn: as low and as high as it gets within each pixel.
colonnade.thinnedBand = function (clock, low, high, from, to, pixels) {
  const band = { x: [], low: [], high: [] };
  for (const [first, last] of parts(clock, from, to, pixels)) {
    const [below, above] = [extremes(low, first, last), extremes(high, first, last)];
    if (below && above) {
      band.x.push(clock.at(first));
      band.low.push(low[below[0]]);
      band.high.push(high[above[1]]);
    }
  }
  return Object.fromEntries(Object.entries(band).map(([name, values]) => [name, Float64Array.from(values)]));
};

// Samples of a view that are flagged, at most one a pixel.
colonnade.flagged = function (clock, values, flags, from, to, pixels) {
  const x = [];
  const y = [];
  const apart = (to - from) / pixels;
  for (const [first, last] of flags) {
    let index = Math.max(first, clock.from(from));
    const end = Math.min(last, clock.from(to));
    while (index < end) {
      if (values[index] === values[index]) {
        x.push(clock.at(index));
        y.push(values[index]);
      }
      index = Math.max(index + 1, clock.from(clock.at(index) + apart));
    }
  }
  return { x: Float64Array.from(x), y: Float64Array.from(y) };
};
