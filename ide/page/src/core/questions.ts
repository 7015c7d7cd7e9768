// Questions to a worker that are open: by their numbers, until they are answered. What is sent and
// what an answer looks like is not known here.

interface Open {
  resolve(answer: unknown): void;
  reject(error: Error): void;
}

export class OpenQuestions {
  private lastId = 0;
  private open = new Map<number, Open>();

  /** A number that nothing has had. */
  newId(): number {
    return ++this.lastId;
  }

  /** The answer to come to the question of a number. */
  answerTo<T>(id: number): Promise<T> {
    return new Promise((resolve, reject) => {
      this.open.set(id, { resolve: (answer) => resolve(answer as T), reject });
    });
  }

  /** The question of a number, which is open no more; none if it is not, or was no question. */
  close(id: number): Open | undefined {
    const open = this.open.get(id);
    this.open.delete(id);
    return open;
  }

  /** Nobody will answer those that are open. */
  rejectAll(error: Error): void {
    const open = [...this.open.values()];
    this.open.clear();
    for (const { reject } of open) reject(error);
  }
}
