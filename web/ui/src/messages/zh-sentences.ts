/** Sentences that the station produces in English only: numbers are {}, in order. */
export const sentences: Record<string, string> = {
  // zeros in the drives
  "The drives hold the old zero offsets.": "驱动器中为旧零点。",
  "The drives hold these zero offsets.": "驱动器中为这些零点。",
  "One drive holds its new zero offset, the other does not.": "一个驱动器已有新零点，另一个没有。",
  "It is unknown whether a drive accepted its new zero. The next run will check.":
    "不清楚驱动器是否接受了新零点。下一次运行会检查。",
  "The zeros of the drives have been changed since, for another run.":
    "此后驱动器的零点已因另一次运行而更改。",
  "Rolled back: the drives hold the old zero offsets again.": "已恢复：驱动器中又是旧零点。",
  // the examination of the devices
  "answers: {} replies, {} ms as a rule, {} ms the slowest": "有应答：{} 次，通常 {} ms，最慢 {} ms",
  "reads {} mm": "读数为 {} mm",
  "stands at {} deg": "位于 {}°",
  "is not powered; a run powers it": "未上电；运行时会上电",
  "the arm": "臂",
  "stands within its workspace": "位于其工作空间内",
  interlocks: "联锁",
};
